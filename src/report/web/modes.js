// A diagram for each mode: on paper a page ends between two of them.
const panels = document.getElementById("plot");
const drawn = [...result.modes, ...result.critical_modes || []];
drawn.forEach((m, k) => {
  const critical = k >= result.modes.length ? `, critical at ${said(m.at, "speed", 6)}` : "";
  const last = k === drawn.length - 1, mode = "lines", x = result.z;
  const panel = panels.appendChild(document.createElement("div"));
  panel.className = "panel";
  draw([{x, y: drawnModes[k].x, name: "x", mode, line: {color: "#0072B2", width: 2.5}},
    {x, y: drawnModes[k].y, name: "y", mode, line: {color: "#D55E00", dash: "dash", width: 2.5}}],
  {height: 200 + (last ? 30 : 0), margin: {l: 75, r: 30, t: 30, b: last ? 55 : 25}, showlegend: k === 0,
    legend: {orientation: "h", x: 1, xanchor: "right", y: 1, yanchor: "bottom"}, xaxis: axis(last ? label("z", "length") : ""), yaxis: axis("", {range: [-1.2, 1.2], dtick: 1}),
    annotations: [{xref: "paper", yref: "paper", x: 0, y: 1, xanchor: "left", yanchor: "bottom", showarrow: false,
      text: `<b>${m.label ?? ""}</b> ${said(m.frequency, "frequency", 7)}, ${drawnModes[k].whirl}${critical}; y ` +
        (drawnModes[k].at_one_instant ? "at the same instant" : "a quarter period later")}]}, panel);
});
// All show the same part of the shaft: a zoom of one is one of all.
const panes = Array.from(panels.children);
let sharing = false;
panes.forEach(panel => panel.on("plotly_relayout", change => {
  const range = change["xaxis.range"] || ["xaxis.range[0]", "xaxis.range[1]"].map(key => change[key]);
  const all = change["xaxis.autorange"] === true;
  if (sharing || !(all || range.every(at => at !== undefined))) return;
  sharing = true;
  Promise.all(panes.filter(other => other !== panel)
    .map(other => Plotly.relayout(other, all ? {"xaxis.autorange": true} : {"xaxis.range": range}))).finally(() => { sharing = false; });
}));
