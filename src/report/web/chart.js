// The figure that is described once for files and pages (result.chart): panels over each other, each with axes of its own.
// A name letter by letter: Plotly takes markup in texts for what it means.
const plain = name => name.replace(/[&<>]/g, letter => ({"&": "&amp;", "<": "&lt;", ">": "&gt;"})[letter]);
const axis = (title, more) => Object.assign({title: {text: title}, gridcolor: "#E4E4E4", zerolinecolor: "#999",
  linecolor: "#333", mirror: true, ticks: "outside", exponentformat: "power", minexponent: 5}, more || {});
// Drawn again with other numbers, a zoom and what is hidden stay as the reader left them.
const draw = (place, traces, layout) => Plotly.react(place, traces, {uirevision: "kept", modebar: {orientation: "v"}, hovermode: "closest", separators: ".",
  plot_bgcolor: "#fff", paper_bgcolor: "#fff", ...layout}, {responsive: true, displaylogo: false});
const symbols = {2: "x-thin", 4: "square-open", 5: "square", 6: "circle-open", 7: "circle", 8: "triangle-up-open", 9: "triangle-up", 11: "triangle-down", 12: "diamond-open"};
const dashOf = dash => dash === "1" ? "solid" : dash.replace(/[()]/g, "").split(",").map(part => part + "px").join(",");
const lines = text => plain(text).replace(/\n/g, "<br>");
const axisOf = (of, name) => axis(plain(of.title), {
  ...([of.low, of.high].every(end => end !== null) ? {range: [of.low, of.high].map(end => of.logarithmic ? Math.log10(end) : end)}
    : name === "y" && !of.logarithmic && of.low === 0 ? {rangemode: "tozero"} : {}),
  ...(of.logarithmic ? {type: "log", dtick: of.low && of.high && of.high < 100 * of.low ? "D2" : 1} : {}), ...(of.step > 0 ? {dtick: of.step} : {}),
  ...(of.names.length ? {tickvals: of.names.map(n => n[0]), ticktext: of.names.map(n => plain(n[1])), automargin: true} : {})});
const traceOf = (curve, panel) => {
  const points = curve.points.length ? curve.points : [[null, null]]; // without any the name alone, in the legend
  const trace = {x: points.map(p => p[0]), y: points.map(p => p[1]), name: plain(curve.name), legendgroup: curve.name || curve.colour};
  if (curve.filled) return {...trace, mode: "lines", line: {color: curve.colour, width: 1}, fill: "toself", fillcolor: curve.colour, ...(curve.texts.length ? {text: lines(curve.texts[0]), hoverinfo: "text"} : {hoverinfo: "name"})};
  return {...trace, mode: [curve.width > 0 ? "lines" : "", curve.marker > 0 || !(curve.width > 0) ? "markers" : ""].filter(m => m).join("+"),
    line: {color: curve.colour, width: curve.width, dash: dashOf(curve.dash)}, marker: {color: curve.colour, symbol: symbols[curve.point] || "circle", size: 8 * (curve.marker || 1),
      ...(curve.every > 1 ? {maxdisplayed: Math.ceil(curve.points.length / curve.every)} : {}), ...(curve.width > 0 && curve.point !== 2 ? {} : {line: {width: 2, color: curve.colour}})},
    text: curve.texts.map(lines), hovertemplate: (curve.texts.length ? "%{text}" : `%{x:.6g} ${panel.x.unit}: %{y:.6g} ${panel.y.unit}`) + `<extra>${plain(curve.name)}</extra>`};
};
function figure(panels, place, more) {
  const gaps = panels.map((p, i) => (p.x.title ? 70 : 34) + (i + 1 < panels.length && panels[i + 1].title ? 22 : 0)), layout = {shapes: [], annotations: []}, traces = [];
  const all = panels.reduce((sum, p, i) => sum + p.height + (i ? gaps[i - 1] : 0), 0), keyed = new Set();
  let top = 0;
  panels.forEach((panel, i) => {
    const number = k => k ? String(k + 1) : "", x = "x" + number(i), y = "y" + number(i), domain = [1 - (top + panel.height) / all, 1 - top / all];
    const at = (of, value) => of.logarithmic ? Math.log10(value) : value;
    // A zoom along what several panels show is one of all of them.
    const same = panels.findIndex(p => p.x.low !== null && ["unit", "low", "high", "logarithmic"].every(key => p.x[key] === panel.x[key]));
    layout["xaxis" + number(i)] = {...axisOf(panel.x, "x"), anchor: y, ...(same >= 0 && same < i ? {matches: "x" + number(same)} : {})};
    layout["yaxis" + number(i)] = {...axisOf(panel.y, "y"), anchor: x, domain: domain.map(end => Math.max(0, end)), ...(panel.square ? {scaleanchor: x} : {})};
    if (panel.title) layout.annotations.push({text: plain(panel.title), x: 0, xref: "paper", xanchor: "left", y: domain[1], yref: "paper", yanchor: "bottom", showarrow: false});
    panel.curves.forEach(curve => {
      traces.push({...traceOf(curve, panel), xaxis: x, yaxis: y, showlegend: curve.name !== "" && !keyed.has(curve.name)});
      keyed.add(curve.name);
    });
    const name = (of, more) => layout.annotations.push({text: plain(of.text), x: at(panel.x, of.x), xref: x, y: at(panel.y, of.y), yref: y, font: {size: 11, color: of.colour}, xanchor: "left", ...more});
    panel.labels.forEach(of => name(of, of.far ? {showarrow: true, arrowhead: 0, arrowwidth: 0.6, ax: of.right, ay: -of.up}
      : {showarrow: false, xshift: of.right, yshift: of.up}));
    panel.ends.forEach(of => name(of, of.top ? {showarrow: false, xanchor: "right", yanchor: "top", xshift: -6} : {showarrow: false, xshift: 6, yshift: of.up}));
    // The operating speeds behind the curves of this panel alone, and what they are where they stand first.
    const band = result.operation, mark = (from, to, text, look) => {
      layout.shapes.push({type: "rect", layer: "below", line: {width: 0}, ...look, ...(panel.x.spin_speed
        ? {xref: x, x0: from, x1: to, yref: y + " domain", y0: 0, y1: 1} : {yref: y, y0: from, y1: to, xref: x + " domain", x0: 0, x1: 1})});
      if (panel.x.spin_speed && !keyed.has(text)) layout.annotations.push({x: at(panel.x, from), xref: x, y: 1, yref: y + " domain", xanchor: "left", yanchor: "top", text,
        showarrow: false, textangle: -90, font: {size: 11, color: "#7A5200"}});
      keyed.add(text);
    };
    if (band && (panel.x.spin_speed || panel.y.spin_speed)) {
      mark(band.from, band.to, "operating speeds", {fillcolor: "#E3EFDA"});
      if (band.trip !== null) mark(band.trip, band.trip, "trip", {type: "line", line: {width: 1.5, color: "#7A5200"}});
    }
    top += panel.height + gaps[i];
  });
  return draw(place, traces, {...layout, height: all + 90, legend: {orientation: "v", x: 1.02, y: 1}, margin: {l: 80, r: 220, t: 30, b: 60}, ...more});
}
// Figures of their own share a zoom too.
function figures(panels) {
  const plot = document.getElementById("plot");
  let sharing = false;
  const panes = panels.map((panel, i) => {
    const pane = plot.appendChild(document.createElement("div")), below = panel.x.title ? 55 : 25;
    pane.className = "panel";
    figure([panel], pane, {height: panel.height + 30 + below, margin: {l: 80, r: 30, t: 30, b: below}, showlegend: i === 0, legend: {orientation: "h", x: 1, xanchor: "right", y: 1.02, yanchor: "bottom"}});
    return pane;
  });
  panes.forEach(pane => pane.on("plotly_relayout", change => {
    const range = change["xaxis.range"] || ["xaxis.range[0]", "xaxis.range[1]"].map(key => change[key]);
    const all = change["xaxis.autorange"] === true;
    if (sharing || !(all || range.every(at => at !== undefined))) return;
    sharing = true;
    Promise.all(panes.filter(other => other !== pane)
      .map(other => Plotly.relayout(other, all ? {"xaxis.autorange": true} : {"xaxis.range": range}))).finally(() => { sharing = false; });
  }));
}
if (result.chart.apart) figures(result.chart.panels); else figure(result.chart.panels, "plot");
