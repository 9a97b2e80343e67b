// Mode shapes in space: the rotor in perspective, all modes in step. No library takes part.
const space = document.getElementById("space"), rotor = result.drawn.rotor;
function drawSpace() {
  const xmlns = "http://www.w3.org/2000/svg", wide = 520, high = 300;
  const make = (parent, name, attributes) => {
    const node = parent.appendChild(document.createElementNS(xmlns, name));
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    return node;
  };
  // World: along the shaft -1 to 1, up is y, away from the reader x. Radii to scale where that can be seen.
  const half = rotor.length / 2, along = z => (z - half) / half;
  const thickest = Math.max(...rotor.segments.map(s => Math.max(s[2], s[3])), ...rotor.discs.map(d => d.radius)) / half;
  const radial = Math.min(Math.max(thickest, 0.1), 0.25) / thickest / half, bow = 0.2, floor = -0.52;
  let yaw = -35 * Math.PI / 180, phase = 0, playing = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  const tilt = 17 * Math.PI / 180, distance = 4.2;
  const seen = (a, up, away) => { // a place of the world on the paper
    const right = a * Math.cos(yaw) + away * Math.sin(yaw), deep = away * Math.cos(yaw) - a * Math.sin(yaw);
    const scale = 215 * distance / (distance + deep * Math.cos(tilt) - up * Math.sin(tilt));
    return [wide / 2 + scale * right, 150 - scale * (up * Math.cos(tilt) + deep * Math.sin(tilt))];
  };
  const path = points => points.map(p => p[0].toFixed(1) + "," + p[1].toFixed(1)).join(" ");
  const circle = Array.from({length: 33}, (_, k) => [Math.cos(k * Math.PI / 16), Math.sin(k * Math.PI / 16)]);
  const radius = z => {
    const s = rotor.segments.find(s => z <= s[1] + 1e-9) || rotor.segments[rotor.segments.length - 1];
    return (s[2] + (s[3] - s[2]) * Math.min(Math.max((z - s[0]) / (s[1] - s[0] || 1), 0), 1)) * radial;
  };
  // Deflection of a mode anywhere, between its stations: parts of x and y, and their slopes.
  const at = (mode, z) => {
    let i = 1;
    while (i < result.z.length - 1 && result.z[i] < z) ++i;
    const step = result.z[i] - result.z[i - 1] || 1, t = (z - result.z[i - 1]) / step;
    const of = list => [(1 - t) * list[i - 1] + t * list[i], (list[i] - list[i - 1]) / step];
    return {xr: of(mode.x_real), xi: of(mode.x_imag), yr: of(mode.y_real), yi: of(mode.y_imag)};
  };
  const moved = (p, order) => [bow * (p.xr[order] * Math.cos(phase) - p.xi[order] * Math.sin(phase)),
    bow * (p.yr[order] * Math.cos(phase) - p.yi[order] * Math.sin(phase))];
  const ring = (z, r) => circle.map(([c, s]) => seen(along(z), r * s, r * c));
  const movers = [], still = [];
  function panel(mode, heading, parent) {
    const svg = make(parent, "svg", {viewBox: `0 0 ${wide} ${high}`, role: "img", "aria-label": "Mode " + heading, "font-family": "DejaVu Sans, Arial, sans-serif"});
    make(svg, "rect", {width: wide, height: high, fill: "#fff"});
    make(svg, "text", {x: 12, y: 22, "font-size": 14, fill: "#222"}).textContent = heading;
    const colour = {forward: "#0072B2", backward: "#D55E00", mixed: "#007D5A"}[mode.whirl];
    const fixed = (attributes, points) => { const line = make(svg, "polyline", {fill: "none", ...attributes}); still.push(() => line.setAttribute("points", path(points()))); };
    fixed({stroke: "#DDD"}, () => [[-1.1, 0.5], [1.1, 0.5], [1.1, -0.5], [-1.1, -0.5], [-1.1, 0.5]].map(([a, x]) => seen(a, floor, x)));
    fixed({stroke: "#999", "stroke-dasharray": "5 4"}, () => [seen(-1.12, 0, 0), seen(1.12, 0, 0)]);
    rotor.bearings.forEach(b => {
      const r = radius(b.z) + 0.05, ink = b.seal ? "#007D5A" : "#444";
      if (!b.seal) fixed({stroke: ink, "stroke-width": 2}, () => [seen(along(b.z), -r, 0), seen(along(b.z), floor, 0), seen(along(b.z), floor, 0.12), seen(along(b.z), floor, -0.12)]);
      fixed({stroke: ink, "stroke-width": 2.2, ...(b.seal ? {"stroke-dasharray": "3 3"} : {})}, () => ring(b.z, r));
    });
    const sense = result.speed < 0 ? -1 : 1; // from x, away, towards y, up
    fixed({stroke: "#555", "stroke-width": 1.5}, () => {
      const arc = Array.from({length: 19}, (_, k) => -0.4 + k * 0.1).map(a => seen(-1.12, 0.13 * Math.sin(sense * a), 0.13 * Math.cos(sense * a)));
      const [x, y] = arc[18], [u, v] = arc[16], n = Math.hypot(x - u, y - v) || 1, e = [(x - u) / n, (y - v) / n];
      return [...arc, [x - 7 * e[0] - 4 * e[1], y - 7 * e[1] + 4 * e[0]], [x, y], [x - 7 * e[0] + 4 * e[1], y - 7 * e[1] - 4 * e[0]]];
    });
    const stations = result.z.map(z => ({z, a: along(z), r: radius(z), p: at(mode, z)}));
    const hull = make(svg, "polygon", {fill: "#C9D3DC", "fill-opacity": 0.75, stroke: "#33404C", "stroke-width": 0.8});
    movers.push(() => {
      const middle = stations.map(s => { const [x, y] = moved(s.p, 0); return [seen(s.a, y, x), seen(s.a, y + s.r, x)]; });
      const side = sign => middle.map(([p, above], i) => {
        const q = middle[Math.min(i + 1, middle.length - 1)][0], o = middle[Math.max(i - 1, 0)][0];
        const n = Math.hypot(q[0] - o[0], q[1] - o[1]) || 1, r = sign * Math.hypot(above[0] - p[0], above[1] - p[1]);
        return [p[0] - r * (q[1] - o[1]) / n, p[1] + r * (q[0] - o[0]) / n];
      });
      hull.setAttribute("points", path([...side(1), ...side(-1).reverse()]));
    });
    rotor.discs.forEach(d => {
      const p = at(mode, d.z), r = Math.max(d.radius * radial, radius(d.z) + 0.03), ink = d.balancer ? "#B77F00" : "#0060A8";
      const faces = [d.half, -d.half].map(shift => [shift, make(svg, "polygon", {fill: d.balancer ? "#F3D9A0" : "#9CC3E6", "fill-opacity": 0.28, stroke: ink, "stroke-width": 0.9})]);
      movers.push(() => {
        const [x, y] = moved(p, 0), [dx, dy] = moved(p, 1).map(slope => slope * half); // sections lean with the bent shaft
        faces.forEach(([shift, face]) => face.setAttribute("points", path(circle.map(([c, s]) => {
          const lean = r * (c * dx + s * dy);
          return seen(along(d.z + shift) - Math.max(Math.min(lean, 0.5), -0.5), y + r * s + shift / half * dy, x + r * c + shift / half * dx);
        }))));
      });
    });
    const places = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1].map(t => t * rotor.length);
    places.forEach(z => {
      const p = at(mode, z), point = make(svg, "circle", {r: 2.6, fill: colour});
      fixed({stroke: colour, "stroke-width": 1.4}, () => circle.map(([c, s]) => seen(along(z), bow * (p.yr[0] * c - p.yi[0] * s), bow * (p.xr[0] * c - p.xi[0] * s))));
      movers.push(() => { const [x, y] = moved(p, 0), [u, v] = seen(along(z), y, x); point.setAttribute("cx", u.toFixed(1)); point.setAttribute("cy", v.toFixed(1)); });
    });
  }
  const group = (heading, modes, headings) => {
    if (!modes.length) return;
    if (heading) { const h = document.createElement("h3"); h.textContent = heading; space.append(h); }
    const grid = document.createElement("figure");
    grid.className = "space";
    space.append(grid);
    modes.forEach((m, k) => panel(m, headings[k], grid));
  };
  const controls = document.createElement("p"), button = document.createElement("button"), label = document.createElement("label"), turn = document.createElement("input");
  controls.className = "controls";
  turn.type = "range"; turn.min = -85; turn.max = 85; turn.value = -35;
  label.append("View ", turn);
  controls.append(button, " ", label);
  space.append(controls);
  const critical = result.critical_modes || [];
  group(critical.length ? result.drawn.at : "", result.modes, result.drawn.modes);
  group("At the critical speeds", critical, result.drawn.critical_modes);
  const show = () => movers.forEach(move => move()), redraw = () => { still.forEach(line => line()); show(); };
  let before = null;
  const frame = now => {
    if (!playing) { before = null; return; }
    if (before !== null) phase = (phase + (now - before) / 2500 * 2 * Math.PI) % (2 * Math.PI);
    before = now;
    show();
    requestAnimationFrame(frame);
  };
  const set = on => { playing = on; button.textContent = on ? "Pause" : "Play"; button.setAttribute("aria-pressed", String(!on)); if (on) requestAnimationFrame(frame); };
  button.addEventListener("click", () => set(!playing));
  turn.addEventListener("input", () => { yaw = turn.value * Math.PI / 180; redraw(); });
  // On paper: the instant of the largest deflection.
  window.addEventListener("beforeprint", () => { set(false); phase = 0; redraw(); });
  redraw();
  set(playing);
}
if (space) drawSpace();
