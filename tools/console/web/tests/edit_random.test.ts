import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { GraphText } from "../src/edit/graph_text.ts";
import { History } from "../src/edit/history.ts";
import { commentsOf } from "../src/edit/splice.ts";
import { check, randomEdit, randomOf } from "./random_edits.ts";

const folder = process.env["JAROL_SPECS"] ?? "../../../specs";
const specs = readdirSync(folder).filter((name) => name.endsWith(".yaml"));
const each = Number(process.env["JAROL_EDITS"] ?? 1000);
const words = (text: string): string[] => commentsOf(text).map((comment) => comment.text).sort();

for (const spec of specs)
  test(`${each} random edits of ${spec}: each does what it says, comments stay, and undo gives the bytes back`, () => {
    const original = readFileSync(join(folder, spec), "utf8");
    const random = randomOf(spec.length);
    const history = new History(original);
    let graph = new GraphText(original);
    let made = 0;
    for (let tries = 0; made < each; ++tries) {
      assert.ok(tries < 5 * each, "most edits can be made");
      const edit = randomEdit(graph, random);
      if (!edit) continue;
      check(edit);
      assert.deepEqual(words(edit.graph.text), words(original), edit.label);
      graph = edit.graph;
      history.add(graph.text, edit.label);
      ++made;
      // now and then back and on again
      if (random(20) === 0) {
        history.undo();
        assert.equal(history.redo(), graph.text);
      }
    }
    while (history.undoes !== undefined) history.undo();
    assert.equal(history.text, original);
    while (history.redoes !== undefined) history.redo();
    assert.equal(history.text, graph.text);
  });
