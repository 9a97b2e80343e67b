const families = {};
result.rows.filter(r => r.true_error > 0).forEach(r => {
  const key = r.family === "classical" ? "classical" : "order " + r.order;
  (families[key] = families[key] || []).push(r);
});
const traces = [];
Object.keys(families).forEach((key, k) => {
  const rows = families[key], text = rows.map(r => `<b>${key}</b>, ${r.elements} elements, ${r.unknowns} unknowns<br>${short(r.seconds * 1000, 4)} ms<br>` +
    `true error ${short(r.true_error, 3)}<br>estimate ${short(r.error_estimate, 3)}`);
  [["unknowns", "x", "y", 1], ["seconds", "x2", "y2", 1000]].forEach(([field, xaxis, yaxis, factor], panel) => traces.push({
    x: rows.map(r => r[field] * factor), y: rows.map(r => r.true_error), xaxis, yaxis, text, hoverinfo: "text", mode: "lines+markers",
    name: key, legendgroup: key, showlegend: panel === 0, line: lineOf(k), marker: {symbol: k, size: 8}}));
});
const log = {type: "log", dtick: 1, exponentformat: "power"};
draw(traces, {xaxis: axis("Unknowns", {...log, domain: [0, 0.46]}), xaxis2: axis("Wall time (ms)", {...log, domain: [0.54, 1], anchor: "y2"}),
  yaxis: axis("True relative error", log), yaxis2: axis("", {...log, anchor: "x2", matches: "y"})});
