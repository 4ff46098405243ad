"use strict";

const at = (id) => document.getElementById(id);
const unpack = (id) => {
  const bytes = Uint8Array.from(atob(at(id).textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
};

const LINES = [
  { color: "#202020" },
  { color: "#3b8fd0", dash: "dash" },
  { color: "#b35c00", dash: "dot" },
  { color: "#00755e", dash: "dashdot" },
  { color: "#8a4b9e", dash: "longdash" },
  { color: "#6b6b6b", dash: "longdashdot" },
];
/** Seen where they coincide. */
const FONT = { family: "system-ui, sans-serif", size: 13, color: "#1b1f24" };
const CONFIG = { displayModeBar: false, responsive: true, displaylogo: false };
const AXIS = { showline: true, ticks: "outside", zeroline: false, linecolor: "#4d5660", gridcolor: "#e3e7ea", automargin: true, exponentformat: "power" };
/** Deeper is darker, as in the pictures of `tribo plot`. */
const DEPTHS = ["#f7fbff", "#d0e1f2", "#94c4df", "#4a98c9", "#1764ab", "#08306b"].map((color, i) => [i / 5, color]);
const ON_WHITE = [[0, "#dccfb4"], ...DEPTHS.slice(2)];
const ALONG = ["Along sliding, x", "Across sliding, y"];

/** Return a place for a chart, with its title and its note; the text stands for the picture. */
function place(parent, title, note) {
  const figure = document.createElement("figure");
  figure.className = "chart";
  const plot = Object.assign(document.createElement("div"), { className: "plot" });
  plot.setAttribute("role", "img");
  const caption = Object.assign(document.createElement("figcaption"), { textContent: note });
  figure.append(plot, caption);
  parent.append(figure);
  plot.dataset.title = title;
  return plot;
}

function layout(title, more) {
  return {
    title: { text: title, font: { size: 14 }, x: 0, xanchor: "left", pad: { l: 4 } },
    font: FONT, height: 340, margin: { l: 60, r: 20, t: 64, b: 48 }, dragmode: false,
    paper_bgcolor: "#fff", plot_bgcolor: "#fff",
    legend: { orientation: "h", x: 0, xanchor: "left", y: 1.01, yanchor: "bottom" }, ...more,
  };
}

/** Return words in lines of about so many letters. */
function wrapped(text, room) {
  const lines = [""];
  text.split(" ").forEach((word) => {
    if (lines.at(-1) && `${lines.at(-1)} ${word}`.length > room) lines.push("");
    lines.push(`${lines.pop()} ${word}`.trim());
  });
  return lines.join("<br>");
}

/** Return an axis from 0, or a logarithmic one whose marks are whole numbers. */
function scaled(text, values) {
  const positive = values.filter((v) => v > 0);
  const [low, high] = [Math.min(...positive), Math.max(...positive)];
  if (!positive.length || high <= 10 * low) return axis(text, { rangemode: "tozero" });
  const marks = [];
  for (let power = Math.floor(Math.log10(low)); 10 ** power <= high; power += 1) {
    marks.push(...[1, 2, 5].map((digit) => digit * 10 ** power));
  }
  return axis(text, { type: "log", tickvals: marks, ticktext: marks.map((mark) => String(Number(mark.toPrecision(1)))) });
}

/** Return where a legend goes: above the curves if it is short, else below, with room for it. */
function legend(curves) {
  if (curves.length === 1 && !curves[0].name) return { showlegend: false };
  const length = curves.reduce((sum, { name }) => sum + name.length + 6, 0);
  if (length < 48) return { showlegend: true };
  const room = 22 * Math.ceil(length / 48);
  return {
    showlegend: true, height: 340 + room, margin: { l: 60, r: 20, t: 44, b: 58 + room },
    legend: { orientation: "h", x: 0, xanchor: "left", yref: "container", y: 0, yanchor: "bottom" },
  };
}

const axis = (text, more) => ({ ...AXIS, title: { text }, ...more });

/** Return flat numbers, x by y, as the rows that Plotly draws; what `hidden` says is left blank. */
function rows(map, values, hidden = () => false) {
  const ny = map.y.length;
  return map.y.map((_, j) => map.x.map((_, i) => {
    const value = values[i * ny + j];
    return hidden(value) ? null : value;
  }));
}

const extreme = (lists, best, start) =>
  lists.reduce((a, list) => list.reduce((b, v) => (v === null ? b : best(b, v)), a), start);

const span = (list) => list[list.length - 1] - list[0] || 1;

/** Draw a map; it and its `peers` of other results have one scale. */
function drawMap(plot, map, peers, save, moment, fixed) {
  const isPressure = map.body === "";
  const isDepth = !isPressure && map.body !== "models";
  const values = map.values[save];
  // Depths keep their scale, so that one sees them grow; temperatures do not begin at 0.
  const steady = fixed || isDepth;
  const lists = peers.flatMap((each) => (steady ? each.values : [each.values[save]]));
  const high = extreme(lists, Math.max, -Infinity);
  const low = isPressure || steady ? Math.min(0, extreme(lists, Math.min, 0)) : extreme(lists, Math.min, Infinity);
  const [ux, uy] = map.units;
  const narrow = map.alike ? Math.min(1, span(map.x) / span(map.y)) : 1;
  const trace = {
    type: "heatmap", x: map.x, y: map.y, z: rows(map, values, (v) => isPressure && v === 0),
    zmin: low, zmax: high > low ? high : low + 1, colorscale: isDepth ? DEPTHS : "Viridis",
    colorbar: { title: { text: map.unit, side: "right" }, thickness: 14, outlinewidth: 0 },
    hovertemplate: `x %{x:.3~f} ${ux}, y %{y:.3~f} ${uy}<br>%{z:.4~g} ${map.unit}<extra></extra>`,
  };
  const largest = `largest ${map.largest[save]} ${map.unit}`;
  plot.setAttribute("aria-label", `${map.name}, map seen from above at ${moment}: ${largest}.`);
  return Plotly.react(plot, [trace], layout(`${wrapped(map.name, 40)}<br><span style="font-size:12px">${largest}</span>`, {
    plot_bgcolor: isPressure ? "#eceff1" : "#fff",
    xaxis: axis(`${ALONG[0]} (${ux})`, {
      showgrid: false, constrain: "domain", constraintoward: "right", tickangle: 0, nticks: Math.max(3, Math.round(6 * narrow)),
    }),
    yaxis: axis(`${ALONG[1]} (${uy})`, {
      showgrid: false, constrain: "domain", ...(map.alike ? { scaleanchor: "x" } : {}),
    }),
    margin: { l: 60, r: 10, t: 58 + 18 * Math.floor(map.name.length / 40), b: 48 },
  }), CONFIG);
}

/** Return curves, each with a look that differs in grey too; the first show beneath those that coincide. */
const lines = (curves, dotted = false) => curves.map(({ name, x, y }, i) => ({
  type: "scatter", x, y, name: wrapped(name, 60), line: { ...LINES[i % LINES.length], ...(dotted ? { dash: "dot", width: 1 } : { width: 2 + 1.5 * Math.min(curves.length - 1 - i, 3) }) }, marker: { size: 6 },
  mode: x.length > 30 && !dotted ? "lines" : "lines+markers",
}));

function drawSection(plot, section, save, moment, fixed) {
  const curves = Object.entries(section.curves).map(([name, { x, values }]) => ({ name, x, y: values[save] }));
  const all = Object.values(section.curves).flatMap(({ values }) => values);
  const shown = section.down || fixed ? all : curves.map(({ y }) => y);
  const high = 1.05 * extreme(shown, Math.max, 0) || 1;
  const low = 1.05 * extreme(shown, Math.min, 0);
  const title = `${section.name}, ${section.axis === 0 ? "along" : "across"} sliding`;
  const largest = curves.map(({ name, y }) => `${name} up to ${extreme([y], Math.max, 0).toPrecision(3)} ${section.unit}`);
  plot.setAttribute("aria-label", `${title}, at ${moment}: ${largest.join(", ")}.`);
  return Plotly.react(plot, lines(curves), layout(title, {
    xaxis: axis(`${ALONG[section.axis]} (${section.along})`),
    yaxis: axis(`${section.down ? "Depth" : "Pressure"} (${section.unit})`, { range: section.down ? [high, low] : [low, high] }),
    ...(curves.length > 1 || section.down ? legend(curves) : { showlegend: false }),
  }), CONFIG);
}

/** Of the box of a surface, whose sides are about 1. */
const HEIGHT = 0.55;
const METRES = { m: 1, mm: 1e-3, "µm": 1e-6, nm: 1e-9 };

function drawSurface(plot, data, surface, save, moment, camera) {
  const map = data.maps[surface.map];
  const depth = map.values[save];
  const height = depth.map((d, i) => (d === null ? null : (surface.height ? surface.height[i] : 0) - d));
  const deepest = extreme(map.values, Math.max, 0);
  const [ux, uy] = map.units;
  const isNarrow = plot.clientWidth < 500;
  const ratio = map.alike ? Math.min(Math.max(span(map.y) / span(map.x), 0.4), 2.5) : 0.6;
  const size = 1.25 / Math.sqrt(0.5 * (1 + ratio * ratio));
  const rise = extreme([height], Math.max, -Infinity) - extreme([height], Math.min, Infinity);
  const times = HEIGHT / rise / METRES[map.unit] / (size / span(map.x) / METRES[ux]);
  const enlarged = rise > 0 && isFinite(times) ? ` ${Number(times.toPrecision(2)).toLocaleString("en")} times` : "";
  const trace = {
    type: "surface", x: map.x, y: map.y, z: rows(map, height), surfacecolor: rows(map, depth),
    cmin: Math.min(0, extreme(map.values, Math.min, 0)), cmax: deepest || 1, colorscale: ON_WHITE,
    // On a narrow page below the surface, whose axes need the width.
    colorbar: { title: { text: `depth, ${map.unit}`, side: isNarrow ? "top" : "right" }, thickness: 14, outlinewidth: 0, nticks: 6, ...(isNarrow ? { orientation: "h", y: 0, yanchor: "bottom" } : {}) },
    hovertemplate: `x %{x:.3~f} ${ux}, y %{y:.3~f} ${uy}<br>height %{z:.4~g} ${map.unit}<extra></extra>`,
  };
  plot.setAttribute("aria-label",
    `Worn surface of ${surface.name} in 3-D at ${moment}: worn down by up to ${map.largest[save]} ${map.unit}.`);
  return Plotly.react(plot, [trace], layout(`Surface of ${surface.name}, heights enlarged${enlarged}`, {
    font: { ...FONT, size: isNarrow ? 10 : 13 }, height: 480, margin: { l: 0, r: 0, t: 44, b: 0 }, dragmode: "turntable",
    scene: {
      camera, domain: { y: [isNarrow ? 0.2 : 0, 1] }, aspectmode: "manual", aspectratio: { x: size, y: size * ratio, z: HEIGHT },
      xaxis: { title: { text: `x (${ux})` }, nticks: 5 }, yaxis: { title: { text: `y (${uy})` }, nticks: 5 },
      zaxis: { title: { text: `height (${map.unit})` }, nticks: 5 },
    },
  }), CONFIG);
}

function drawHistory(plot, panel, label, isLog) {
  const values = panel.curves.flatMap(({ y }) => y.filter((v) => v !== null));
  const [low, high] = [Math.min(...values), Math.max(...values)];
  // As a temperature, far from 0.
  const isFar = panel.dotted && low < high && low > 0.5 * high;
  const ends = panel.curves.map(({ name, y }) => `${name} ${y[y.length - 1]} ${panel.unit}`);
  plot.setAttribute("aria-label", `${panel.name} against ${label}; at the end: ${ends.join(", ")}.`);
  return Plotly.react(plot, lines(panel.curves, panel.dotted), layout(panel.name, {
    xaxis: isLog ? scaled(label, panel.curves.flatMap(({ x }) => x)) : axis(label, { rangemode: "tozero" }),
    yaxis: panel.log ? scaled(panel.unit, values) : axis(panel.unit, { rangemode: isFar ? "normal" : "tozero" }),
    ...legend(panel.curves),
  }), CONFIG);
}

function hasWebGL() {
  const canvas = document.createElement("canvas");
  return Boolean(canvas.getContext("webgl2") || canvas.getContext("webgl"));
}

/** Let buttons turn the surface: by `turn` 24ths of a circle, and `tilt` of the height. */
function turned(camera, turn, tilt) {
  const { x, y, z } = camera.eye;
  const [radius, angle] = [Math.hypot(x, y, z), Math.atan2(y, x) + (turn * Math.PI) / 12];
  const up = Math.min(Math.max(Math.asin(z / radius) + (tilt * Math.PI) / 16, -1.5), 1.5);
  const flat = radius * Math.cos(up);
  return { ...camera, eye: { x: flat * Math.cos(angle), y: flat * Math.sin(angle), z: radius * Math.sin(up) } };
}

async function showMoments(data) {
  const [slider, fixed] = [at("save"), at("fixed")];
  const maps = data.maps.map((map) => place(at("maps"), map.name, map.note));
  const pressures = data.maps.filter(({ body }) => body === "");
  const peers = data.maps.map((map) => (map.body === "" ? pressures : [map]));
  const sections = data.sections.map((section) => place(at("sections"), section.name, section.note));
  const surfaces = hasWebGL() ? data.surfaces : [];
  const surfacePlot = surfaces.length ? place(at("surface"), "surface", data.maps[surfaces[0].map].note) : null;
  if (!data.surfaces.length) at("turning")?.remove();
  else if (!surfaces.length) {
    at("surface").textContent = "This browser draws no 3-D: its WebGL is off. Turn on hardware acceleration in its settings, or open this file in another browser; the maps above have the same depths.";
    document.querySelectorAll("#bodies, #turning .buttons").forEach((part) => part.remove());
  }
  // A narrow page shows less to both sides.
  const far = Math.max(1, 550 / (at("surface")?.clientWidth || 550));
  let camera = { eye: { x: 1.3 * far, y: -1.5 * far, z: far }, center: { x: 0, y: 0, z: -0.15 } };
  let shown = 0;
  choices(at("bodies") ?? document.createElement("p"), "body", surfaces.map(({ name }) => name), (i) => {
    shown = i;
    draw();
  });
  slider.max = data.saves.length - 1;
  slider.value = slider.max;
  if (data.left_out) at("saves-left-out").textContent = `${data.left_out} further saves are left out to keep this file small.`;

  function draw() {
    const save = Number(slider.value);
    const { time, distance } = data.saves[save];
    const moment = `${time}, ${distance}`;
    at("said").textContent = moment;
    slider.setAttribute("aria-valuetext", moment);
    const drawn = [
      ...maps.map((plot, i) => drawMap(plot, data.maps[i], peers[i], save, moment, fixed.checked)),
      ...sections.map((plot, i) => drawSection(plot, data.sections[i], save, moment, fixed.checked)),
    ];
    if (surfacePlot) {
      camera = surfacePlot._fullLayout?.scene?.camera ?? camera;
      drawn.push(drawSurface(surfacePlot, data, surfaces[shown], save, moment, camera));
    }
    return Promise.all(drawn);
  }

  const step = (by) => {
    slider.value = Number(slider.value) + by;
    draw();
  };
  slider.addEventListener("input", draw);
  fixed.addEventListener("change", draw);
  at("earlier").addEventListener("click", () => step(-1));
  at("later").addEventListener("click", () => step(1));
  document.querySelectorAll("[data-turn]").forEach((button) => button.addEventListener("click", () => {
    const [turn, tilt] = button.dataset.turn.split(",").map(Number);
    camera = turned(surfacePlot._fullLayout.scene.camera, turn, tilt);
    Plotly.relayout(surfacePlot, { "scene.camera": camera });
  }));
  await draw();
}

/** Return a group of radio buttons in `parent`, the first chosen; `changed` gets the index. */
function choices(parent, name, words, changed) {
  words.forEach((text, i) => {
    const label = document.createElement("label");
    const input = Object.assign(document.createElement("input"), { type: "radio", name, value: i, checked: i === 0 });
    input.addEventListener("change", () => changed(i));
    label.append(input, ` ${text}`);
    parent.append(label);
  });
}

async function showHistory(history) {
  const panels = history.axes[0].panels;
  if (!panels.length) {
    at("past").remove();
    return;
  }
  const plots = panels.map((panel) => place(at("history"), panel.name, panel.note));
  const draw = (chosen) => {
    const { label, log, panels: drawn } = history.axes[chosen];
    return Promise.all(plots.map((plot, i) => drawHistory(plot, drawn[i], label, log)));
  };
  choices(at("against"), "against", history.axes.map(({ name }) => `against ${name}`), draw);
  await draw(0);
}

async function show() {
  const script = document.createElement("script");
  script.textContent = await unpack("plotly");
  document.head.append(script);
  const data = JSON.parse(await unpack("data"));
  // Charts take their size from what they are in, so it has to be there first.
  document.documentElement.classList.add("drawn");
  try {
    if (data.saves) await showMoments(data);
    if (data.history) await showHistory(data.history);
  } catch (error) {
    document.documentElement.classList.remove("drawn");
    throw error;
  }
  document.documentElement.dataset.ready = "yes";
}

at("copy")?.addEventListener("click", async () => {
  try {
    await navigator.clipboard.writeText(at("case").textContent);
    at("copy-said").textContent = "Copied.";
  } catch {
    getSelection().selectAllChildren(at("case"));
    at("copy-said").textContent = "Selected; copy it with Ctrl+C.";
  }
});
if (at("data")) show();
