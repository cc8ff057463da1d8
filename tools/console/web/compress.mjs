// The built files as the server sends them: compressed, and together no larger than the page may be.
import { readdirSync, readFileSync, unlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const max = 400_000;
let sum = 0;
for (const entry of readdirSync("dist", { recursive: true, withFileTypes: true })) {
  if (!entry.isFile()) continue;
  const path = join(entry.parentPath ?? entry.path, entry.name);
  const bytes = gzipSync(readFileSync(path), { level: 9 });
  writeFileSync(`${path}.gz`, bytes);
  unlinkSync(path);
  sum += bytes.length;
}
console.log(`the page has ${sum} bytes, compressed`);
if (sum > max) throw new Error(`the page has ${sum} bytes compressed, and at most ${max} are allowed`);
