"use strict";
const studio = JSON.parse(document.getElementById("studio").textContent);
const page = Array.from(crypto.getRandomValues(new Uint32Array(2)), n => n.toString(16)).join("");
const patience = 300; // ms after which a computation gives way to the next values
const previewPatience = 1500; // the same of a coarse one: sooner nothing would be seen while a slider moves
const byId = id => document.getElementById(id);
const made = (name, more, ...inside) => { const node = Object.assign(document.createElement(name), more); node.append(...inside); return node; };
let count = 0; // of questions: the newest has the largest number

async function post(path, question) {
  try {
    const answer = await fetch(path + "?token=" + studio.token, {method: "POST", body: JSON.stringify(question)});
    return await answer.json();
  } catch (error) {
    return {failed: "whirl studio does not answer: has it been ended? (" + error.message + ")"};
  }
}
function say(text, bad) {
  byId("said").textContent = text;
  byId("said").hidden = !text;
  byId("said").classList.toggle("bad", Boolean(bad));
}

// Fields: the text is the value; the slider moves the number in it and leaves its unit.
const steps = 200; // of a slider from end to end
class Field {
  constructor(from) {
    Object.assign(this, from);
    this.begun = from.text;
    const name = this.group === "the case" ? this.label : `${this.group}: ${this.label}`;
    this.exact = made("input", {className: "exact", value: this.text, spellcheck: false, title: this.path + (this.line ? `, line ${this.line}` : "")});
    this.exact.setAttribute("aria-label", name);
    this.slider = made("input", {type: "range", tabIndex: -1});
    this.slider.setAttribute("aria-label", name + ", slider");
    this.unit = made("span", {className: "unit"});
    this.back = made("button", {type: "button", className: "back", textContent: "↺", title: "as in the case: " + this.begun});
    this.problem = made("p", {className: "problem", hidden: true});
    this.node = made("div", {className: "field"}, made("span", {className: "name", textContent: this.label}), this.exact, this.slider, this.back, this.problem);
    this.node.children[0].append(" ", this.unit);
    this.node.dataset.path = this.path;
    this.exact.addEventListener("input", () => this.set(this.exact.value, true));
    this.slider.addEventListener("input", () => this.slide());
    this.back.addEventListener("click", () => { this.write(this.begun); });
    this.take(this.number, true);
  }
  // The number in the text, and where its slider goes: half of it on either side, counts to twice theirs.
  take(number, centre) {
    this.number = number;
    this.unit.textContent = number && !number.unit && this.si ? this.si : "";
    this.slider.disabled = !number || (number.value === 0 && !this.whole);
    this.slider.title = this.slider.disabled ? "no size to move by: write a number" : "";
    if (this.slider.disabled || !centre) return;
    const at = number.value, reach = this.whole ? Math.max(2, Math.abs(at)) : Math.abs(at) / 2;
    this.low = this.whole ? Math.max(Math.min(0, at), at - reach) : at - reach;
    this.high = at + reach;
    const step = this.whole ? 1 : (this.high - this.low) / steps;
    this.slider.min = 0;
    this.slider.max = Math.round((this.high - this.low) / step);
    this.step = step;
    this.slider.value = Math.round((at - this.low) / step);
  }
  slide() {
    const at = this.low + Number(this.slider.value) * this.step;
    const number = this.whole ? String(Math.round(at)) : String(Number(at.toPrecision(4)));
    this.exact.value = number + (this.number && this.number.unit ? " " + this.number.unit : "");
    this.set(this.exact.value, false);
  }
  write(text) { this.exact.value = text; this.set(text, true); }
  set(text, centre) {
    this.text = text;
    this.centre = this.centre || centre;
    this.node.classList.toggle("changed", this.changed());
    byId("undo").disabled = changes().length === 0;
    refresh();
  }
  changed() { return this.text !== this.begun; }
  mistake(texts) {
    this.problem.textContent = texts.join("\n");
    this.problem.hidden = texts.length === 0;
    this.node.classList.toggle("wrong", texts.length > 0);
    if (texts.length) this.node.closest("details").open = true;
  }
}
const fields = studio.fields.map(from => new Field(from)), fieldAt = new Map(fields.map(field => [field.path, field]));
const changes = () => fields.filter(field => field.changed());
const values = () => Object.fromEntries(changes().map(field => [field.path, field.text]));
const groups = new Map();
fields.forEach(field => {
  if (!groups.has(field.group)) {
    groups.set(field.group, made("details", {open: groups.size < 12}, made("summary", {textContent: field.group})));
    byId("fields").append(groups.get(field.group));
  }
  groups.get(field.group).append(field.node);
});
byId("fields").addEventListener("submit", event => event.preventDefault());
byId("find").addEventListener("input", () => {
  const words = byId("find").value.toLowerCase().split(/\s+/).filter(word => word);
  fields.forEach(field => { field.node.hidden = !words.every(word => (field.group + " " + field.path).toLowerCase().includes(word)); });
  fields.forEach(field => { field.node.style.display = field.node.hidden ? "none" : ""; });
  groups.forEach(group => {
    const any = Array.from(group.querySelectorAll(".field")).some(node => !node.hidden);
    group.hidden = !any;
    if (any && words.length) group.open = true;
  });
});

// A panel shows one analysis. At most one computation of it runs; what is wanted meanwhile waits for it, or
// takes its place once it has run for too long.
class Panel {
  constructor(offer) {
    Object.assign(this, offer);
    this.state = made("span", {className: "state"});
    this.failure = made("p", {className: "failure", hidden: true});
    this.frame = made("iframe", {title: this.heading});
    this.node = made("section", {className: "panel", hidden: true}, made("h2", {textContent: this.heading}), this.state, this.failure, this.frame);
    this.node.dataset.command = this.command;
    this.box = made("input", {type: "checkbox", value: this.command});
    const label = made("label", {title: this.why_not}, this.box, " " + this.heading);
    label.classList.toggle("idle", Boolean(this.why_not));
    byId("offers").append(label);
    byId("panels").append(this.node);
    this.box.addEventListener("change", () => this.choose(this.box.checked));
  }
  choose(visible) {
    this.box.checked = visible;
    this.node.hidden = !visible;
    if (visible && !this.loaded) this.loaded = new Promise(loaded => {
      this.frame.addEventListener("load", () => {
        new ResizeObserver(() => this.fit()).observe(this.frame.contentDocument.body);
        loaded();
      }, {once: true});
      this.frame.src = this.panel;
    });
    if (visible) refresh(); else this.stop();
  }
  fit() {
    const height = this.frame.contentDocument.body.scrollHeight + 24;
    if (Math.abs(height - this.frame.clientHeight) > 2) this.frame.style.height = height + "px";
  }
  stop() {
    clearTimeout(this.timer);
    this.wanted = this.running = null;
    this.previewed = false;
    this.tell();
  }
  ask(wanted, edited) {
    if (this.running ? wanted === this.running.wanted : wanted === this.shown) {
      this.wanted = null;
      if (!this.running) this.mark();
      return;
    }
    this.wanted = wanted;
    this.edited = edited;
    if (!this.running) this.start();
    else {
      clearTimeout(this.timer);
      const wait = this.running.coarse ? previewPatience : this.running.previewed ? 0 : patience;
      this.timer = setTimeout(() => { if (this.wanted !== null) this.start(); }, Math.max(0, wait - (performance.now() - this.running.since)));
    }
  }
  async start() {
    clearTimeout(this.timer);
    const run = this.running = {wanted: this.wanted, edited: this.edited, since: performance.now(), coarse: this.slow};
    this.wanted = null;
    settle();
    this.clock = this.clock || setInterval(() => this.tell(), 500);
    const ask = preview => post("compute", {command: this.command, page, number: ++count, values: JSON.parse(run.wanted), preview});
    // Where the last one took long, first a coarse one, which is shown until the full one is there.
    if (run.coarse) {
      const answer = await ask(true);
      await this.loaded;
      if (this.running !== run) return;
      run.coarse = false;
      run.previewed = answer.main !== undefined && this.frame.contentWindow.show(answer) === null;
      if (run.previewed) { this.took = performance.now() - run.edited; this.previewed = true; this.shown = null; this.fit(); }
      this.tell();
      if (this.wanted !== null) { this.running = null; this.start(); return; }
      run.since = performance.now();
    }
    const answer = await ask(false);
    await this.loaded;
    if (this.running !== run) return; // a newer one runs, or nobody looks any more
    this.slow = performance.now() - run.since > patience;
    this.previewed = false;
    if (answer.main !== undefined) {
      const wrong = this.frame.contentWindow.show(answer);
      this.failed = wrong ? "the diagram could not be drawn: " + wrong : "";
      if (!wrong && !run.previewed) this.took = performance.now() - run.edited;
      this.fit();
    } else this.failed = answer.failed || "the computation was given up";
    this.shown = run.wanted;
    this.running = null;
    if (this.wanted !== null) this.start();
    this.mark();
  }
  tell() {
    if (!this.running) { clearInterval(this.clock); this.clock = null; }
    const seconds = this.running ? (performance.now() - this.running.since) / 1000 : 0;
    if (this.running && seconds < 0.4 && !this.previewed) return;
    this.state.textContent = this.running ? (this.running.previewed ? "preview; " : "") + `computing, ${seconds.toFixed(0)} s` : this.failed ? "the last good picture" : "";
    this.node.classList.toggle("preview", Boolean(this.running && this.running.previewed));
    this.node.classList.toggle("stale", problems > 0 || (seconds > 0 && !this.running.previewed) || Boolean(this.failed));
  }
  mark() {
    this.failure.textContent = this.failed || "";
    this.failure.hidden = !this.failed;
    this.tell();
    settle();
  }
}
const panels = studio.offers.map(offer => new Panel(offer));

// The newest values: first whether they are a case, then the pictures that are seen.
let checking = false, again = false, problems = 0, editedAt = performance.now();
function settle() {
  document.body.dataset.state = checking ? "checking" : problems ? "problems"
    : panels.some(panel => panel.box.checked && (panel.running || panel.wanted !== null)) ? "computing" : "idle";
}
function showProblems(list) {
  problems = list.length;
  const own = new Map(), others = [];
  list.forEach(problem => {
    if (fieldAt.has(problem.key)) own.set(problem.key, (own.get(problem.key) || []).concat(problem.text));
    else others.push([problem.key, problem.text].filter(text => text).join(": "));
  });
  fields.forEach(field => field.mistake(own.get(field.path) || []));
  byId("problems").replaceChildren(...others.map(text => made("p", {textContent: text})));
  panels.forEach(panel => panel.tell());
}
async function refresh() {
  editedAt = performance.now();
  if (checking) { again = true; return; }
  checking = true;
  settle();
  do {
    again = false;
    const at = editedAt, now = values(), answer = await post("check", {values: now});
    if (again) continue;
    if (answer.failed) { say(answer.failed, true); break; }
    if (byId("said").classList.contains("bad")) say("");
    fields.forEach(field => {
      const number = field.path in now ? answer.numbers[field.path] : field.from_case;
      if (field.centre || !field.changed()) field.take(number, field.centre || field.number !== number);
      field.centre = false;
    });
    showProblems(answer.problems);
    if (answer.changed) say("The case file has changed since this page was made of it: end whirl studio and start it again to see it.", true);
    if (!problems) panels.filter(panel => panel.box.checked).forEach(panel => panel.ask(JSON.stringify(now), at));
    else panels.forEach(panel => panel.stop());
  } while (again);
  checking = false;
  settle();
}
fields.forEach(field => { field.from_case = field.number; });

byId("undo").addEventListener("click", () => changes().forEach(field => field.write(field.begun)));
byId("file").textContent = [studio.file, ...studio.set.map(text => `--set "${text}"`)].join(" ");

// Save: a new file beside the case; one that is there is replaced only where that is said.
byId("save").addEventListener("click", () => {
  byId("save_said").textContent = "";
  byId("save_replace").hidden = true;
  byId("saving").showModal();
});
byId("name").addEventListener("input", () => { byId("save_said").textContent = ""; byId("save_replace").hidden = true; });
byId("saving").addEventListener("submit", async event => {
  const how = event.submitter ? event.submitter.value : "go";
  if (how === "no") return;
  event.preventDefault();
  const answer = await post("save", {name: byId("name").value, values: values(), replace: how === "replace"});
  byId("save_replace").hidden = !answer.exists;
  if (answer.saved) { byId("saving").close(); say("Saved as " + answer.saved + "."); }
  else byId("save_said").textContent = answer.exists ? answer.exists + " is there already." : answer.failed;
});
byId("report").addEventListener("click", async () => {
  const view = window.open("", "_blank"); // now: later it would be taken for a pop-up
  byId("report").disabled = true;
  say("The report is being made …");
  const answer = await post("make_report", {page, number: ++count, values: values()});
  byId("report").disabled = false;
  if (answer.report) {
    say("The report is " + answer.file + ".");
    if (view) view.location = answer.report;
  } else {
    say(answer.failed || "the report was given up", true);
    if (view) view.close();
  }
});
window.addEventListener("pagehide", () => navigator.sendBeacon("leave?token=" + studio.token, JSON.stringify({page})));
window.addEventListener("pageshow", event => { if (event.persisted) location.reload(); });
(panels.find(panel => !panel.why_not) || panels[0]).choose(true);
