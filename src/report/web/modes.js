// Two modes beside one another, as in the picture: so many rows go on one page of paper.
const traces = [], count = result.modes.length, columns = count > 1 ? 2 : 1, rows = Math.ceil(count / columns);
const name = (letter, index) => letter + (index ? index + 1 : ""), column = k => k % columns, row = k => Math.floor(k / columns);
const across = [[0, columns > 1 ? 0.47 : 1], [0.53, 1]];
result.modes.forEach((m, k) => {
  const common = {x: result.z.map(z => z * metres), xaxis: name("x", column(k)), yaxis: name("y", k), showlegend: k === 0, mode: "lines"};
  traces.push({...common, y: drawnModes[k].x, name: "x", legendgroup: "x", line: {color: "#0072B2", width: 2.5}});
  traces.push({...common, y: drawnModes[k].y, name: "y", legendgroup: "y", line: {color: "#D55E00", dash: "dash", width: 2.5}});
});
const layout = {height: 120 + 190 * rows, annotations: []};
for (let c = 0; c < columns; ++c) { // the numbers along the shaft stand under the lowest of the column
  const lowest = Math.max(0, ...result.modes.map((_, k) => k).filter(k => column(k) === c));
  layout[name("xaxis", c)] = axis("z (m)", {anchor: name("y", lowest), domain: across[c]});
}
result.modes.forEach((m, k) => {
  const top = 1 - (row(k) + 0.14) / rows, bottom = 1 - (row(k) + 0.84) / rows; // the name above
  layout[name("yaxis", k)] = axis("", {domain: [bottom, top], range: [-1.2, 1.2], dtick: 1, anchor: name("x", column(k))});
  layout.annotations.push({xref: "paper", yref: "paper", x: across[column(k)][0], y: top, xanchor: "left", yanchor: "bottom", showarrow: false,
    text: `<b>${m.label}</b> ${short(m.frequency * hertz, 7)} Hz, ${m.whirl}; y ` +
      (drawnModes[k].atOneInstant ? "at the same instant" : "a quarter period later")});
});
draw(traces, layout);
