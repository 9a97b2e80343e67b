// The figure that is described once for files and pages (result.chart): panels over each other, each with axes of its own.
const panels = result.chart.panels, gaps = panels.map((p, i) => (p.x.title ? 70 : 34) + (i + 1 < panels.length && panels[i + 1].title ? 22 : 0)), layout = {shapes: [], annotations: []}, traces = [];
const symbols = {2: "x-thin", 4: "square-open", 5: "square", 6: "circle-open", 7: "circle", 8: "triangle-up-open", 9: "triangle-up", 11: "triangle-down", 12: "diamond-open"};
const dashOf = dash => dash === "1" ? "solid" : dash.replace(/[()]/g, "").split(",").map(part => part + "px").join(",");
const all = panels.reduce((sum, p, i) => sum + p.height + (i ? gaps[i - 1] : 0), 0), keyed = new Set();
const own = (name, axis) => [axis.low, axis.high].every(end => end !== null)
  ? {range: [axis.low, axis.high].map(end => axis.logarithmic ? Math.log10(end) : end)} : name === "y" && !axis.logarithmic && axis.low === 0 ? {rangemode: "tozero"} : {};
let top = 0;
panels.forEach((panel, i) => {
  const number = i ? String(i + 1) : "", x = "x" + number, y = "y" + number, domain = [1 - (top + panel.height) / all, 1 - top / all];
  const more = (name, of) => ({...own(name, of), ...(of.logarithmic ? {type: "log", dtick: of.low && of.high && of.high < 100 * of.low ? "D2" : 1} : {}), ...(of.step > 0 ? {dtick: of.step} : {})});
  layout["xaxis" + number] = axis(plain(panel.x.title), {anchor: y, ...more("x", panel.x)});
  layout["yaxis" + number] = axis(plain(panel.y.title), {anchor: x, domain: domain.map(end => Math.max(0, end)), ...more("y", panel.y)});
  if (panel.title) layout.annotations.push({text: plain(panel.title), x: 0.5, xref: "paper", y: domain[1], yref: "paper", yanchor: "bottom", showarrow: false});
  panel.curves.forEach(curve => {
    const first = curve.name !== "" && !keyed.has(curve.name);
    keyed.add(curve.name);
    const points = curve.points.length ? curve.points : [[null, null]]; // without any the name alone, in the legend
    traces.push({x: points.map(p => p[0]), y: points.map(p => p[1]), xaxis: x, yaxis: y, name: plain(curve.name), showlegend: first,
      legendgroup: curve.name || curve.colour, mode: [curve.width > 0 ? "lines" : "", curve.marker > 0 || !(curve.width > 0) ? "markers" : ""].filter(m => m).join("+"),
      line: {color: curve.colour, width: curve.width, dash: dashOf(curve.dash)}, marker: {color: curve.colour, symbol: symbols[curve.point] || "circle", size: 8 * (curve.marker || 1), ...(curve.every > 1 ? {maxdisplayed: Math.ceil(curve.points.length / curve.every)} : {}),
        ...(curve.width > 0 && curve.point !== 2 ? {} : {line: {width: 2, color: curve.colour}})},
      ...(curve.texts.length ? {text: curve.texts.map(plain)} : {}),
      hovertemplate: (curve.texts.length ? "%{text}<br>" : "") + `%{x:.6g} ${panel.x.unit}: %{y:.6g} ${panel.y.unit}<extra>${plain(curve.name)}</extra>`});
  });
  panel.labels.forEach(label => layout.annotations.push({text: plain(label.text), x: label.x, xref: x, y: panel.y.logarithmic ? Math.log10(label.y) : label.y, yref: y,
    showarrow: true, arrowhead: 0, arrowwidth: 0.6, ax: 40, ay: -22, font: {size: 11}}));
  // The operating speeds behind the curves of this panel alone.
  const at = result.operation, across = (from, to, look) => layout.shapes.push({type: "rect", layer: "below", line: {width: 0}, ...look, ...(panel.x.spin_speed
    ? {xref: x, x0: from, x1: to, yref: y + " domain", y0: 0, y1: 1} : {yref: y, y0: from, y1: to, xref: x + " domain", x0: 0, x1: 1})});
  if (at && (panel.x.spin_speed || panel.y.spin_speed)) {
    across(at.from, at.to, {fillcolor: "#E3EFDA"});
    if (at.trip !== null) across(at.trip, at.trip, {type: "line", line: {width: 1.5, color: "#7A5200"}});
  }
  top += panel.height + gaps[i];
});
draw(traces, {...layout, height: all + 90, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 30, b: 60}});
