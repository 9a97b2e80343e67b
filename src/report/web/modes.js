const traces = [];
result.modes.forEach((m, k) => {
  const yaxis = k ? "y" + (k + 1) : "y", showlegend = k === 0, mode = "lines";
  traces.push({x: result.z.map(z => z * metres), y: drawnModes[k].x, yaxis, name: "x", legendgroup: "x", showlegend, mode, line: {color: "#0072B2", width: 2.5}});
  traces.push({x: result.z.map(z => z * metres), y: drawnModes[k].y, yaxis, name: "y", legendgroup: "y", showlegend, mode, line: {color: "#D55E00", dash: "dash", width: 2.5}});
});
const count = result.modes.length, layout = {height: 120 + 190 * count, xaxis: axis("z (m)", {anchor: count > 1 ? "y" + count : "y"}), annotations: []};
result.modes.forEach((m, k) => {
  const top = 1 - (k + 0.14) / count, bottom = 1 - (k + 0.84) / count; // the name above
  layout["yaxis" + (k ? k + 1 : "")] = axis("", {domain: [bottom, top], range: [-1.2, 1.2], dtick: 1});
  layout.annotations.push({xref: "paper", yref: "paper", x: 0, y: top, xanchor: "left", yanchor: "bottom", showarrow: false,
    text: `<b>${m.label}</b> ${short(m.frequency * hertz, 7)} Hz, ${m.whirl}; y ` +
      (drawnModes[k].atOneInstant ? "at the same instant" : "a quarter period later")});
});
draw(traces, layout);
