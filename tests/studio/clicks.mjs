// A hundred random edits by clicks and keys: none leaves the page broken.
// Usage: node clicks.mjs PROGRAM CASE [edits] [seed]; status 1 where one does.
import { Browser, quiet, studio, whichBrowser } from "./browser.mjs";

const [program, scene, edits = "100", seed = "1"] = process.argv.slice(2);

// Numbers from 0 to 1 that follow from the seed: a linear congruential generator modulo 2^32.
let state = Number(seed);
const random = () => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return state / 2 ** 32; };
const one = list => list[Math.floor(random() * list.length)];

const name = whichBrowser(); // before anything runs that would outlive the end
const whirl = await studio(program, [scene]);
const browser = new Browser(name);
let failed = 0;
const complain = text => { console.log(text); failed = 1; };
try {
  await browser.open(whirl.address);
  await browser.until(quiet, "the first picture");
  const paths = await browser.evaluate('fields.map(field => field.path)');
  const offers = await browser.evaluate('panels.filter(panel => !panel.why_not).map(panel => panel.command)');
  for (let edit = 1; edit <= Number(edits); ++edit) {
    const path = one(paths), field = `[data-path="${path}"]`, what = random();
    let done;
    if (what < 0.5) {
      const across = 0.05 + 0.9 * random();
      done = `slider of ${path} at ${across.toFixed(2)}`;
      await browser.click(`${field} input[type=range]`, across);
    } else if (what < 0.75) {
      const text = one(["", "-1", "1e400", "5 kg", "1,5", "nan", "\"", "{k = 1}", "<b>x</b>", "12 furlongs", "0", "1e30", "[1, 2]", "1e-3", "2"]);
      done = `"${text}" in ${path}`;
      await browser.type(`${field} .exact`, text);
    } else if (what < 0.85) {
      done = `${path} back`;
      if (await browser.evaluate(`document.querySelector(${JSON.stringify(field)}).classList.contains("changed")`)) await browser.click(`${field} .back`);
    } else if (what < 0.95) {
      const command = one(offers);
      done = `${command} shown or hidden`;
      await browser.click(`input[value=${command}]`);
    } else {
      done = "all changes undone";
      if (!(await browser.evaluate('document.getElementById("undo").disabled'))) await browser.click("#undo");
    }
    await new Promise(later => setTimeout(later, 60 * random())); // some come before the last picture
    if (random() < 0.4) continue;
    await browser.until(quiet, `edit ${edit}, ${done}`);
    // Where there are mistakes they stand on the page; else every panel has a picture, or says why not.
    const broken = await browser.evaluate(`(() => {
      if (document.body.dataset.state === "problems")
        return document.querySelector(".field .problem:not([hidden]), #problems p") ? "" : "mistakes that stand nowhere";
      return panels.filter(panel => panel.box.checked).map(panel => {
        if (!panel.failure.hidden) return panel.failure.textContent && panel.node.classList.contains("stale") ? "" : panel.command + ": a failure without a word";
        const inside = panel.frame.contentDocument;
        return inside.querySelector("#plot .main-svg") && inside.querySelector("table") && !panel.node.classList.contains("stale")
          ? "" : panel.command + ": no picture";
      }).join("");
    })()`);
    if (broken) complain(`edit ${edit}, ${done}: ${broken}`);
  }
  // In the end the case is what it was.
  if (!(await browser.evaluate('document.getElementById("undo").disabled'))) await browser.click("#undo");
  await browser.until('document.body.dataset.state === "idle"', "all changes undone");
  if (await browser.evaluate("changes().length")) complain("changes are left");
  for (const error of browser.errors) complain("on the console: " + error);
} catch (error) {
  complain(String(error));
} finally {
  await browser.close();
  whirl.process.removeAllListeners("exit");
  const ended = new Promise(told => whirl.process.on("exit", (status, signal) => told(signal)));
  whirl.process.kill("SIGINT");
  if ((await ended) !== "SIGINT") complain("Ctrl-C has not ended it");
}
process.exit(failed);
