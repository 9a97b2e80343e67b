// Chromium without a window, driven through its DevTools protocol over a pipe: needs no package.
import { spawn } from "node:child_process";
import { accessSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

// Its name; where none is installed the program ends with status 77.
export function whichBrowser() {
  const name = ["chromium", "chromium-browser", "google-chrome"].find(own =>
    process.env.PATH.split(":").some(folder => { try { accessSync(folder + "/" + own); return true; } catch { return false; } }));
  if (!name) { console.log("no browser is installed"); process.exit(77); }
  return name;
}

export class Browser {
  #next = 1;
  #waiting = new Map();
  #rest = "";
  errors = []; // of the console and of scripts

  constructor(program) {
    this.folder = mkdtempSync(join(tmpdir(), "whirl-browser-"));
    this.process = spawn(program, ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
      "--disable-background-networking", "--disable-dev-shm-usage", "--remote-debugging-pipe", `--user-data-dir=${this.folder}`,
      "--window-size=1500,1000"], {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
    this.process.stdio[4].setEncoding("utf8").on("data", text => this.#take(text));
  }
  #take(text) {
    const parts = (this.#rest + text).split("\0");
    this.#rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) {
        const {done, failed} = this.#waiting.get(message.id);
        this.#waiting.delete(message.id);
        if (message.error) failed(new Error(message.error.message)); else done(message.result);
      } else if (message.method === "Runtime.exceptionThrown") {
        const details = message.params.exceptionDetails;
        this.errors.push(details.exception?.description ?? details.text);
      } else if (message.method === "Log.entryAdded" && message.params.entry.level === "error")
        this.errors.push(message.params.entry.text + " " + (message.params.entry.url ?? ""));
    }
  }
  ask(method, params = {}, sessionId = this.session) {
    const id = this.#next++;
    this.process.stdio[3].write(JSON.stringify({id, method, params, ...(sessionId ? {sessionId} : {})}) + "\0");
    return new Promise((done, failed) => this.#waiting.set(id, {done, failed}));
  }
  async open(address) {
    const {targetId} = await this.ask("Target.createTarget", {url: "about:blank"}, undefined);
    this.session = (await this.ask("Target.attachToTarget", {targetId, flatten: true}, undefined)).sessionId;
    for (const domain of ["Page", "Runtime", "Log"]) await this.ask(domain + ".enable");
    await this.ask("Page.navigate", {url: address});
  }
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.ask("Runtime.evaluate", {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  async until(expression, what, seconds = 60) {
    for (let left = seconds * 50; !(await this.evaluate(expression)); --left) {
      if (left <= 0) throw new Error(`${what}: not after ${seconds} s`);
      await new Promise(later => setTimeout(later, 20));
    }
  }
  // A click of the mouse at a part of what a selector finds.
  async click(selector, across = 0.5) {
    const at = await this.evaluate(`(() => { const node = document.querySelector(${JSON.stringify(selector)});
      node.scrollIntoView({block: "center"}); const r = node.getBoundingClientRect();
      return {x: r.left + ${across} * r.width, y: r.top + r.height / 2}; })()`);
    for (const type of ["mousePressed", "mouseReleased"])
      await this.ask("Input.dispatchMouseEvent", {type, ...at, button: "left", clickCount: 1});
  }
  // In place of what stands in a field.
  async type(selector, text) {
    await this.click(selector);
    await this.evaluate(`document.querySelector(${JSON.stringify(selector)}).select()`);
    if (text) await this.ask("Input.insertText", {text});
    else for (const type of ["keyDown", "keyUp"]) await this.ask("Input.dispatchKeyEvent", {type, key: "Delete", code: "Delete", windowsVirtualKeyCode: 46});
  }
  async picture() {
    return Buffer.from((await this.ask("Page.captureScreenshot", {format: "png"})).data, "base64");
  }
  async close() {
    await this.ask("Browser.close", {}, undefined).catch(() => {});
    await new Promise(ended => { this.process.once("exit", ended); setTimeout(() => { this.process.kill("SIGKILL"); }, 3000).unref(); });
    rmSync(this.folder, {recursive: true, force: true, maxRetries: 5});
  }
}

// A whirl studio at work on a case: its process and address. What it says to standard error is passed on.
export function studio(program, words) {
  const process = spawn(program, ["studio", ...words], {stdio: ["ignore", "pipe", "inherit"]});
  return new Promise((done, failed) => {
    let said = "";
    process.stdout.setEncoding("utf8").on("data", text => {
      said += text;
      const address = said.match(/^(http:\/\/127\.0\.0\.1:\d+\/\?token=[0-9a-f]{32})\n/);
      if (address) done({process, address: address[1]});
    });
    process.on("exit", status => failed(new Error("whirl studio ended with " + status)));
  });
}
// All computations that the fields ask for are done.
export const quiet = 'document.readyState === "complete" && ["idle", "problems"].includes(document.body.dataset.state)';
