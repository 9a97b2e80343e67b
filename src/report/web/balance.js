const traces = [], green = "#007D5A", grey = "#A9B4BF", orange = "#D55E00";
const rows = result.planes.map((p, i) => ({name: placed(p.name || "plane " + (i + 1), p.z), of: p}));
if (result.planes.length > 1) rows.push({name: "all planes together", of: result.joint});
if (result.balanced_position) rows.push({name: "real balancers stable", of: {stable: result.balanced_position.bands,
  some: result.balanced_position.arrangements > 1 ? result.balanced_position.with_some : []}});
const ended = (kind, symbol, colour, name) => {
  const runs = result.simulated.filter(run => (["balanced", "undecided"].includes(run.outcome) ? run.outcome : "other") === kind);
  if (!runs.length && kind === "undecided") return;
  traces.push({x: runs.map(run => run.speed), y: runs.map(() => "motions in time"), mode: "markers", name, hoverinfo: "text",
    marker: {symbol, color: colour, size: 10}, text: runs.map(run => `${said(run.speed, "speed", 7)}: ${run.outcome}` +
      (run.residual_ratio === null ? "" : `<br>left of the amplitude: ${short(run.residual_ratio, 3)}`) +
      (run.growth === null ? "" : `<br>growth about balance: ${said(run.growth, "rate", 3)}`))});
};
if (result.simulated.length) {
  ended("balanced", "circle", "#0072B2", "in time: ends balanced");
  ended("other", "x", orange, "in time: does not");
  ended("undecided", "circle-open", "#7A7A7A", "in time: undecided");
}
const bars = (key, kind, colour) => {
  const trace = {type: "bar", orientation: "h", name: kind, base: [], x: [], y: [], text: [], hoverinfo: "text",
    textposition: "none", marker: {color: colour}};
  rows.slice().reverse().forEach(r => (r.of[key] || []).forEach(b => {
    trace.base.push(b[0]); trace.x.push(b[1] - b[0]); trace.y.push(r.name);
    trace.text.push(`${kind}: ${short(b[0], 10)} … ${said(b[1], "speed", 10)}`);
  }));
  traces.push(trace);
};
bars("rigid_bands", "rigid closed form", grey);
bars("bands", "balances", green);
if (result.balanced_position) {
  bars("stable", "balanced position stable", "#0072B2");
  if (result.balanced_position.arrangements > 1) bars("some", "stable with some arrangement of the balls", "#A6CBE3");
}
const points = result.joint.signature, bodyMass = result.drawn.body_mass;
const sizes = points.flatMap(p => p.eigenvalues.map(v => Math.abs(v * bodyMass))).filter(v => v > 1e-7);
const unit = 10 ** Math.floor(Math.log10(Math.min(1, ...sizes)));
const fold = v => Math.sign(v) * Math.log10(1 + Math.abs(v) / unit);
result.planes.forEach((_, k) => [[-1, green, "negative"], [1, orange, "positive"]].forEach(([sign, colour, name]) => {
  const x = [], y = [], hover = [];
  points.forEach((p, i) => {
    if (i && result.critical_speeds.some(c => c >= points[i - 1].speed && c < p.speed)) { x.push(null); y.push(null); hover.push(""); }
    const v = p.eigenvalues[k] * bodyMass;
    x.push(p.speed); y.push(v * sign >= 0 ? fold(v) : null);
    hover.push(`${said(p.speed, "speed", 7)}<br>eigenvalue ${k + 1}: ${said(p.eigenvalues[k], "inverse_mass", 6)}<br>× mass: ${short(v, 6)}<br>` +
      `${p.negative} of ${result.planes.length} negative<br>imbalances of the largest: ${p.worst_real.map(s => short(s, 3)).join(", ")}`);
  });
  traces.push({x, y, text: hover, hoverinfo: "text", mode: "lines+markers", name, legendgroup: name, showlegend: k === 0,
    line: {color: colour}, marker: {size: 4}, yaxis: "y2"});
}));
const top = Math.min(fold(1e3), Math.max(1, ...sizes.map(fold))), ticks = [0];
for (let power = Math.round(Math.log10(unit)) + 1; fold(10 ** power) <= top; power += 1) ticks.push(10 ** power, -(10 ** power));
const shapes = result.critical_speeds.map(c => ({type: "line", xref: "x", yref: "paper", x0: c, x1: c, y0: 0, y1: 1,
  line: {color: "#777", dash: "dot", width: 1}}));
draw(traces, {height: 480 + 70 * rows.length, shapes, barmode: "group", bargap: 0.3, margin: {l: 170, r: 30, t: 30, b: 60},
  xaxis: speedAxis({anchor: "y2", range: [result.speeds[0], result.speeds[result.speeds.length - 1]]}),
  yaxis: axis("", {type: "category", domain: [0.52, 1], categoryorder: "array",
    categoryarray: (result.simulated.length ? ["motions in time"] : []).concat(rows.map(r => r.name).reverse())}),
  yaxis2: axis(result.rigid ? "Eigenvalues × mass" : label("Eigenvalues", "inverse_mass"), {domain: [0, 0.46], range: [-1.05 * top, 1.05 * top],
    tickvals: ticks.map(fold), ticktext: ticks.map(t => t === 0 ? "0" : short(t, 1).replace("-", "−"))})});
