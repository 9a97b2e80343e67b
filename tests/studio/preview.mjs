// The coarse picture of the studio by clicks: after a change it comes first, marked as a preview and of the new numbers, and the full one
// takes its place; of two changes the last is drawn, and none stays for good, whatever comes between.
// Usage: node preview.mjs PROGRAM CASE; status 1 where something of that is not so.
import { Browser, quiet, studio, whichBrowser } from "./browser.mjs";

const [program, scene] = process.argv.slice(2);
const speeds = 4001; // of the full picture: it takes longer than the patience of the page (0.3 s) on any machine
const coarse = 12; // speeds of a coarse one
const name = whichBrowser(); // before anything runs that would outlive the end
const whirl = await studio(program, [scene, `--set=speeds.count=${speeds}`]);
const browser = new Browser(name);
let failed = 0;
const expect = (so, text) => { if (!so) { console.log("not so: " + text); failed = 1; } };
// Everything that is drawn: number of speeds, the first frequency at the last of them, and how the panel looked half a frame later.
const watch = `(() => {
  const panel = panels.find(one => one.command === "campbell"), inside = panel.frame.contentWindow, show = inside.show;
  window.drawn = [];
  inside.show = parts => {
    const wrong = show(parts), result = JSON.parse(parts.result), seen = {speeds: result.speeds.length, wrong,
      frequency: result.modes[0].frequency.at(-1), traces: inside.document.getElementById("plot").data.length, at: performance.now()};
    window.drawn.push(seen);
    setTimeout(() => { seen.preview = panel.node.classList.contains("preview"); seen.stale = panel.node.classList.contains("stale");
      seen.state = panel.state.textContent; }, 0);
    return wrong;
  };
})()`;
const drawn = async () => { await new Promise(later => setTimeout(later, 50)); return browser.evaluate("window.drawn.splice(0)"); };
const field = '[data-path="bearing[0].k"]';
try {
  await browser.open(whirl.address);
  await browser.until(quiet, "the first picture");
  expect(await browser.evaluate('panels.find(one => one.command === "campbell").slow'), "the full picture is slow");
  await browser.evaluate(watch);

  // One change: the coarse picture, then the full one, of the same numbers.
  await browser.click(`${field} input[type=range]`, 0.1);
  await browser.until("window.drawn.length === 2", "a coarse picture and a full one");
  await browser.until(quiet, "the full picture");
  let [first, second, ...more] = await drawn();
  expect(first.speeds === coarse && second.speeds === speeds && more.length === 0, `${coarse} speeds, then ${speeds}: ${first.speeds}, ${second.speeds}`);
  expect(first.wrong === null && second.wrong === null && first.traces > 0, "both are drawn");
  expect(first.preview && !first.stale && /^preview; computing/.test(first.state), `the coarse one is marked: "${first.state}"`);
  expect(!second.preview && !second.stale && second.state === "", `the full one is not: "${second.state}"`);
  // Of the same rotor: two-node elements and others of order 1 differ by less than 5 %, the slider moves the stiffness by 10 to 40 %.
  expect(Math.abs(first.frequency / second.frequency - 1) < 0.05, `one frequency: ${first.frequency}, ${second.frequency}`);
  const soft = second.frequency;

  // Two changes: the second comes while the full picture of the first is computed, which is never drawn.
  await browser.click(`${field} input[type=range]`, 0.5);
  await browser.until("window.drawn.length === 1", "the coarse picture of the first change");
  await browser.click(`${field} input[type=range]`, 0.9);
  await browser.until("window.drawn.length === 3", "the pictures of the second change");
  await browser.until(quiet, "the full picture");
  const three = await drawn();
  expect(three.map(one => one.speeds).join() === [coarse, coarse, speeds].join(), `two coarse ones and one full: ${three.map(one => one.speeds)}`);
  expect(three[0].frequency > soft && three[1].frequency > three[0].frequency, "a stiffer bearing, a higher frequency");
  expect(Math.abs(three[1].frequency / three[2].frequency - 1) < 0.05, "the full one is of the second change");

  // A mistake while the full one is computed: the coarse picture stays, grey and no longer a preview in the making.
  const before = await browser.evaluate(`document.querySelector('${field} .exact').value`);
  await browser.click(`${field} input[type=range]`, 0.3);
  await browser.until("window.drawn.length === 1", "the coarse picture");
  await browser.type(`${field} .exact`, "5 kg");
  await browser.until('document.body.dataset.state === "problems"', "the mistake");
  const look = await browser.evaluate(`(() => { const panel = panels.find(one => one.command === "campbell");
    return [panel.node.classList.contains("preview"), panel.node.classList.contains("stale"), panel.state.textContent]; })()`);
  expect(!look[0] && look[1] && !/computing/.test(look[2]), `after a mistake: ${look}`);
  // Back at the numbers of the last full picture, which the coarse one has taken the place of: it is drawn again.
  await drawn();
  await browser.type(`${field} .exact`, before);
  await browser.until('document.body.dataset.state !== "problems"', "no mistake");
  await browser.until(quiet, "the picture of the numbers before");
  const last = (await drawn()).at(-1);
  expect(last && last.speeds === speeds && !last.stale && last.frequency === three[2].frequency, "the full picture of the numbers before");
  for (const error of browser.errors) expect(false, "no error on the console: " + error);
} catch (error) {
  expect(false, String(error));
} finally {
  await browser.close();
  whirl.process.removeAllListeners("exit");
  whirl.process.kill("SIGINT");
}
process.exit(failed);
