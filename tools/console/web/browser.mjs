// The page in a browser: jarol runs, Chromium watches. browser.mjs JAROL [FOLDER]: with a folder, pictures of all views
// go there. Exit code 77: there is no browser.
import { spawn } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { strict as assert } from "node:assert";

const [jarol, folder] = process.argv.slice(2);
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};

let chromium;
try {
  ({ chromium } = await import("playwright-core"));
} catch {
  skip("playwright-core is not installed; npm could not fetch it");
}
const program = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
if (!program) skip("Chromium is not installed");
if (folder) mkdirSync(folder, { recursive: true });

const browser = await chromium.launch({
  executablePath: program,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"],
});

/** Runs jarol; `url` is there once it has said where the page is. */
function start(...words) {
  const child = spawn(jarol, words, { stdio: ["ignore", "pipe", "pipe"] });
  let output = "";
  let errors = "";
  child.stdout.on("data", (data) => (output += data));
  const url = new Promise((resolve, reject) => {
    child.stderr.on("data", (data) => {
      errors += data;
      const found = /console: (\S+)/.exec(errors);
      if (found) resolve(found[1]);
    });
    child.on("exit", () => reject(new Error(`jarol has ended: ${errors}`)));
  });
  const ended = new Promise((resolve) => child.on("exit", (code) => resolve({ code, output, errors })));
  url.catch(() => {});
  return { child, url, ended };
}

/** A page that complains of nothing, and asks nobody but jarol. */
async function open(url, size = { width: 1280, height: 720 }, theme = "light") {
  const context = await browser.newContext({ viewport: size, colorScheme: theme });
  const page = await context.newPage();
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(String(error)));
  page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
  page.on("request", (request) => {
    const to = request.url();
    if (!to.startsWith(new URL(url).origin) && !/^(blob|data):/.test(to)) wrong.push(`asks ${to}`);
  });
  await page.goto(url);
  return { page, wrong, context };
}

const seconds = async (page) => {
  const [minutes, rest] = (await page.locator("header output").first().innerText()).split(":");
  return Number(minutes) * 60 + Number(rest);
};
async function reach(page, t) {
  for (let tries = 0; tries < 600; ++tries) {
    if ((await seconds(page)) >= t) return;
    await page.waitForTimeout(100);
  }
  assert.fail(`the page has not come to ${t} s`);
}
async function picture(page, name) {
  if (folder) await page.screenshot({ path: `${folder}/${name}.png` });
}

const panels = ["3-D", "Graph", "Plots", "Instruments", "Events"];

async function watch(graph, name, until, pace) {
  const run = start("run", graph, "--console", "--pace", String(pace));
  const { page, wrong, context } = await open(await run.url);
  for (const panel of panels) await page.getByRole("region", { name: panel, exact: true }).waitFor();
  await page.getByText("live", { exact: true }).waitFor();
  await reach(page, until);
  // halted, it stays; a step takes it on
  await page.getByRole("button", { name: "Pause" }).click();
  await page.getByText("paused", { exact: true }).waitFor();
  await page.waitForTimeout(300);
  const halted = await seconds(page);
  await page.getByRole("button", { name: "Step" }).click();
  await page.waitForFunction(
    (before) => {
      const [m, s] = document.querySelector("header output").innerText.split(":");
      return Number(m) * 60 + Number(s) > before;
    },
    halted,
    { timeout: 20_000 },
  );
  assert.ok((await seconds(page)) - halted < 0.2, "a step is one instant");
  for (const theme of ["light", "dark"]) {
    if ((await page.evaluate(() => document.documentElement.dataset.theme)) !== theme)
      await page.getByRole("button", { name: `${theme} colours` }).click();
    await page.waitForTimeout(400);
    await picture(page, `${name}_${theme}`);
    for (const panel of panels) {
      await page.getByRole("button", { name: `${panel}: all the room` }).click();
      await page.waitForTimeout(500);
      await picture(page, `${name}_${panel.toLowerCase().replace("-", "")}_${theme}`);
      await page.getByRole("button", { name: `${panel}: back to its place` }).click();
    }
  }
  return { run, page, wrong, context };
}

try {
  // a dive: watched, looked back at, to its end
  {
    const { run, page, wrong, context } = await watch("specs/exolauv.yaml", "dive", 30, 10);
    const depth = page.getByRole("region", { name: "Instruments" }).getByRole("row", { name: /^depth/ });
    assert.match(await depth.innerText(), /depth\s+[23]\.\d\d\s+[23]\.\d\d\s+m/);
    await page.getByRole("button", { name: /^task depth/ }).press("Enter");
    await page.getByRole("complementary", { name: "values of depth" }).getByText("moment.angle").waitFor();
    await page.getByRole("slider", { name: "instant" }).focus();
    await page.keyboard.press("Home");
    assert.ok((await seconds(page)) < 0.1, "Home looks at the begin");
    assert.match(await depth.innerText(), /depth\s+-?0\.\d\d/);
    await page.getByRole("button", { name: "Live" }).click();
    await page.getByRole("combobox", { name: "signal to add" }).fill("navigation.motion.u");
    await page.getByRole("figure", { name: "plot of navigation.motion.u" }).waitFor();
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "CSV" }).click();
    assert.equal((await download).suggestedFilename(), "exolauv.csv");
    await page.getByRole("combobox", { name: "speed" }).selectOption("max");
    await page.getByRole("button", { name: "Go on" }).click();
    await page.getByRole("log").getByText("digest").waitFor({ timeout: 60_000 });
    await page.getByText("ended", { exact: true }).waitFor();
    await picture(page, "dive_end");
    const { code, output } = await run.ended;
    assert.equal(code, 0);
    const digest = /digest\s+(0x\w+)/.exec(output)[1];
    assert.ok((await page.getByRole("log").innerText()).includes(digest), "the page has the run's digest");
    assert.deepEqual(wrong, []);
    await context.close();
    console.log("dive: watched, paused, stepped, looked back at, to its end");
  }
  // a flight, on a tablet at last
  {
    const { run, page, wrong, context } = await watch("specs/javiator.yaml", "flight", 20, 5);
    const altitude = page.getByRole("region", { name: "Instruments" }).getByRole("row", { name: /^altitude/ });
    assert.match(await altitude.innerText(), /altitude\s+(0\.9|1\.0)\d\s/);
    await page.setViewportSize({ width: 820, height: 1180 });
    await page.waitForTimeout(400);
    await picture(page, "flight_tablet");
    run.child.kill("SIGINT");
    assert.equal((await run.ended).code, 130);
    assert.deepEqual(wrong, []);
    await context.close();
    console.log("flight: watched, stepped, interrupted");
  }
} finally {
  await browser.close();
}
console.log("browser: PASSED");
