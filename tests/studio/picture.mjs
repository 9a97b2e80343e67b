// The picture of docs/studio.md, or how long an edit takes to become a picture.
// Usage: node picture.mjs PROGRAM CASE OUT.png    or    node picture.mjs PROGRAM CASE
import { writeFileSync } from "node:fs";
import { Browser, quiet, studio } from "./browser.mjs";

const [program, scene, out] = process.argv.slice(2);
const whirl = await studio(program, [scene]);
const browser = new Browser("chromium");
const slide = async across => {
  const path = await browser.evaluate('(fields.find(f => /^bearing.*\\.k/.test(f.path) && !f.slider.disabled) || fields.find(f => !f.slider.disabled && !f.whole)).path');
  await browser.click(`[data-path="${path}"] input[type=range]`, across);
  await new Promise(later => setTimeout(later, 50));
  await browser.until(quiet, path, 120);
};
try {
  await browser.open(whirl.address);
  await browser.until(quiet, "the first picture", 120);
  if (out) {
    await slide(0.75);
    writeFileSync(out, await browser.picture());
  } else {
    const offers = await browser.evaluate("panels.filter(panel => !panel.why_not).map(panel => panel.command)"), found = [];
    for (const command of offers) {
      await browser.evaluate(`panels.forEach(panel => panel.choose(panel.command === "${command}"))`);
      await browser.until(quiet, command, 120);
      const times = [];
      for (const across of [0.4, 0.55, 0.45, 0.6, 0.5]) {
        await slide(across);
        const [took, failed] = await browser.evaluate(`(() => { const p = panels.find(panel => panel.command === "${command}"); return [p.took, p.failed]; })()`);
        times.push(failed ? NaN : took);
      }
      times.sort((a, b) => a - b);
      found.push(`${command} ${(times[2] / 1000).toFixed(2)}`);
    }
    console.log(scene.split("/").pop() + ": " + found.join(", "));
  }
} catch (error) {
  console.log(scene + ": " + error);
  process.exitCode = 1;
} finally {
  await browser.close();
  whirl.process.kill("SIGINT");
}
