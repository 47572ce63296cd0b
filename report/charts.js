// SPDX-License-Identifier: BSD-3-Clause
// What every page draws its figures with: data blocks, axes, export, print. No network, no storage.
'use strict';
const Charts = (() => {
const $ = (selector, root = document) => root.querySelector(selector);

// What is drawn for: the screen, paper, or a file of a picture (both light, of fixed width [px]).
const kPaperWidth = 690, kPictureWidth = 900;
let fixedWidth = 0;
const narrow = () => !fixedWidth && window.innerWidth < 620, onPaper = () => fixedWidth === kPaperWidth;

// ---------------------------------------------------------------- data blocks
async function inflate(id, format = 'deflate') {
  const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(format));
  return new Response(stream).arrayBuffer();
}
const inflateText = async (id, format) => new TextDecoder().decode(await inflate(id, format));

// Undoes pack() of report.cpp: bytes sorted by significance, differences, a step.
async function inflateNumbers(name, step) {
  const bytes = new Uint8Array(await inflate('data-' + name));
  const n = bytes.length / 4, out = step === 1 ? new Int32Array(n) : new Float32Array(n);
  let value = 0;
  for (let k = 0; k < n; ++k) {
    value = (value + (bytes[k] | bytes[n + k] << 8 | bytes[2 * n + k] << 16 | bytes[3 * n + k] << 24)) | 0;
    out[k] = value === -2147483648 ? NaN : value * step;
  }
  return out;
}

// A table of numbers by column name.
async function table(name) {
  const text = await inflateText('data-' + name);
  const lines = text.trimEnd().split('\n'), names = lines[0].split(',');
  const columns = Object.fromEntries(names.map((column) => [column, new Float64Array(lines.length - 1)]));
  for (let row = 1; row < lines.length; ++row) {
    const fields = lines[row].split(',');
    names.forEach((column, c) => { columns[column][row - 1] = fields[c] === '' ? NaN : Number(fields[c]); });
  }
  return { ...columns, rows: lines.length - 1, csv: text };
}

// ---------------------------------------------------------------- small tools
const times = (values, factor) => Array.from(values, (v) => v * factor);
const unique = (values) => [...new Set(values)].sort((a, b) => a - b);
const whereEqual = (values, wanted) => { const out = []; values.forEach((v, k) => { if (v === wanted) out.push(k); }); return out; };
const finite = (values) => values.filter((v) => Number.isFinite(v));
function largest(values) { let m = -Infinity; for (const v of values) if (v > m) m = v; return m; }
function smallest(values) { let m = Infinity; for (const v of values) if (v < m) m = v; return m; }
// Fixed notation with a number of significant digits.
function digits(value, count = 3) {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.floor(Math.log10(Math.abs(value)));
  return size < -4 || size > 5 ? value.toExponential(count - 1).replace(/e\+?(-?)(\d+)/, (_, s, e) => ' × 10' + (s ? '⁻' : '') + [...e].map((d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]).join(''))
                               : value.toFixed(Math.max(0, count - 1 - size));
}
const kSteps = [1, 2, 5];
// The largest of 1, 2, 5, 10, … not above a value.
function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * kSteps.filter((s) => s * power <= value * (1 + 1e-12)).at(-1);
}

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
function transparent(colour, alpha) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  return `rgba(${r}, ${g}, ${b}, ${alpha})`;
}
const kDepthScale = [[0, '#f3f0d8'], [.12, '#d7dd9a'], [.3, '#7fbf7b'], [.5, '#35958f'], [.7, '#2b6a8f'], [.86, '#343f84'], [1, '#35175c']];

// ---------------------------------------------------------------- what figures have in common
function axis(title, more = {}) {
  return { title: { text: title, standoff: 8, font: { size: 13.5 } }, gridcolor: css('--grid'), zeroline: false, linecolor: css('--line'),
           ticks: 'outside', tickcolor: css('--line'), ticklen: 4, automargin: true, exponentformat: 'power', ...more };
}

// The part of axis titles and labels that plotly would take for markup.
const plain = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');

function sceneAxis(title, more = {}) {
  return { gridcolor: css('--grid'), linecolor: css('--line'), zeroline: false, showbackground: false, tickfont: { size: 11.5 }, showspikes: false,
           color: css('--muted'), nticks: 5, ticks: 'outside', ticklen: 4, tickcolor: css('--line'), title: { text: title }, ...more };
}

function baseLayout(more) {
  return {
    paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)', autosize: !fixedWidth, ...(fixedWidth ? { width: fixedWidth } : {}),
    font: { family: fixedWidth ? 'Arial, Helvetica, "Liberation Sans", sans-serif' : getComputedStyle(document.body).fontFamily, size: 13, color: css('--ink') },
    margin: { l: 56, r: narrow() ? 12 : 20, t: 34, b: 48 }, dragmode: narrow() ? false : 'zoom', hovermode: 'closest',
    hoverlabel: { bgcolor: css('--panel'), bordercolor: css('--line'), font: { color: css('--ink') } },
    modebar: { bgcolor: 'rgba(0,0,0,0)', color: css('--muted'), activecolor: css('--ink') },
    legend: { orientation: 'h', x: 0, y: 1.01, xanchor: 'left', yanchor: 'bottom', font: { size: 12.5 } },
    ...more,
  };
}

// A colour bar beside the plot; on a phone below it.
function colourBar(title, below = -0.28) {
  const common = { outlinewidth: 0, exponentformat: 'power', tickfont: { size: narrow() ? 11.5 : 12 } };
  return narrow() ? { ...common, orientation: 'h', y: below, yanchor: 'top', thickness: 12, len: 1, title: { text: title, side: 'top' } }
                  : { ...common, thickness: 14, len: 1, title: { text: title, side: 'right' } };
}

// Lays the page out as on paper while a picture of fixed width is described.
function inPrint(width, describe) {
  const before = fixedWidth, theme = document.documentElement.dataset.theme;
  fixedWidth = width;
  document.documentElement.dataset.theme = 'light';
  try {
    return describe();
  } finally {
    fixedWidth = before;
    if (theme) document.documentElement.dataset.theme = theme; else delete document.documentElement.dataset.theme;
  }
}

// ---------------------------------------------------------------- figures
const figures = [];

function button(text, label, press) {
  const out = document.createElement('button');
  out.type = 'button';
  out.textContent = text;
  out.setAttribute('aria-label', label);
  out.addEventListener('click', press);
  return out;
}

function save(name, blob, link = document.createElement('a')) {
  const url = URL.createObjectURL(blob);
  link.href = url;
  link.download = name;
  setTimeout(() => URL.revokeObjectURL(url), 30000);
  return link;
}

// The figure's link gives the data that the page carries, so that it works where the page stands alone.
function offerCsv(link, name, csv) {
  link.setAttribute('download', name);
  link.setAttribute('aria-label', 'Download the data as CSV');
  link.addEventListener('click', () => save(name, new Blob([csv()], { type: 'text/csv' }), link));
}

// A figure: draw(controls, changed, width) gives { traces, layout, caption, height } or { empty: 'why there is nothing' }.
function figure(id, draw, file, csv) {
  const root = document.getElementById(id);
  const entry = { root, plot: $('.plot', root), draw, file, csv, controls: {}, drawn: false };
  for (const control of root.querySelectorAll('[data-control]')) {
    entry.controls[control.dataset.control] = control;
    control.addEventListener('change', () => queue(() => render(entry, control.dataset.control)));
  }
  offerCsv($('a.csv', root), file, csv);
  const name = id.replace('fig-', '');
  entry.buttons = ['SVG', 'PNG'].map((format) => button(format, `Save this figure as ${format}`, () =>
    picture(entry, format.toLowerCase()).then((blob) => save(`${name}.${format.toLowerCase()}`, blob).click()).catch(fail)));
  $('.links', root).append(' ', entry.buttons[0], ' ', entry.buttons[1]);
  figures.push(entry);
  return entry;
}

const widthOf = (entry) => fixedWidth || entry.plot.clientWidth;
const isScene = (traces) => traces.some(({ type }) => type === 'mesh3d');

async function render(entry, changed) {
  const { plot, root } = entry, result = entry.draw(entry.controls, changed, widthOf(entry));
  if (result.caption !== undefined) $('.words', root).textContent = result.caption;
  for (const item of entry.buttons) item.hidden = Boolean(result.empty);
  $('a.csv', root).hidden = Boolean(result.empty);
  entry.drawn = true;
  if (result.empty) {
    const note = document.createElement('p');
    note.className = 'empty';
    note.textContent = result.empty;
    plot.replaceChildren(note);
    plot.style.height = '';
    return;
  }
  if (result.height) plot.style.height = `${result.height}px`;
  // A colour bar cannot turn from upright to lying in place, so another shape of page means a new plot.
  if (entry.narrow !== narrow()) Plotly.purge(plot);
  entry.narrow = narrow();
  entry.width = widthOf(entry);
  await Plotly.react(plot, result.traces, baseLayout(result.layout), {
    responsive: true, displaylogo: false, displayModeBar: narrow() ? false : 'hover', modeBarButtons: [result.buttons ?? ['resetScale2d']],
  });
  if (isScene(result.traces) && !fixedWidth) entry.scene = 'changed';
}

// The figure as a reader would put it into a document: light, of fixed width, seen as it is turned on the page.
async function picture(entry, format) {
  const { traces, layout, height } = inPrint(kPictureWidth, () => {
    const result = entry.draw(entry.controls, undefined, kPictureWidth);
    return { ...result, layout: baseLayout(result.layout) };
  });
  for (const name of Object.keys(layout).filter((key) => /^scene\d*$/.test(key))) {
    const camera = entry.plot.layout?.[name]?.camera;
    if (camera) layout[name] = { ...layout[name], camera };
  }
  Object.assign(layout, { paper_bgcolor: '#ffffff', plot_bgcolor: '#ffffff', autosize: false });
  const size = { width: kPictureWidth, height: height ?? entry.plot.clientHeight };
  const url = await Plotly.toImage({ data: traces, layout, config: {} }, { format, ...size, scale: format === 'svg' ? 1 : 3 });
  const [head, body] = [url.slice(0, url.indexOf(',')), url.slice(url.indexOf(',') + 1)];
  if (!head.includes('base64')) return new Blob([decodeURIComponent(body)], { type: 'image/svg+xml' });
  return new Blob([Uint8Array.from(atob(body), (c) => c.charCodeAt(0))], { type: 'image/png' });
}

// A view in 3D is drawn by the graphics card a moment later than paper waits for, so paper gets a picture of it.
async function pictureForPaper(entry) {
  if (entry.scene !== 'changed') return;
  entry.scene = 'pictured';
  const blob = await picture(entry, 'png');
  let image = $('img.on-paper', entry.root);
  if (!image) {
    image = document.createElement('img');
    image.className = 'on-paper';
    image.alt = entry.plot.getAttribute('aria-label');
    entry.plot.after(image);
    entry.plot.classList.add('off-paper');
  } else URL.revokeObjectURL(image.src);
  image.src = URL.createObjectURL(blob);
  await image.decode();
}

// One after the other: a change of theme or width may come while the figures are still being drawn.
let drawing = Promise.resolve();
const queue = (work) => (drawing = drawing.then(work).catch(fail));
const renderAll = () => queue(async () => { for (const entry of figures) await render(entry); });

const pause = () => new Promise((resolve) => (window.requestIdleCallback ?? setTimeout)(resolve, { timeout: 300 }));
const inView = ({ plot }) => { const box = plot.getBoundingClientRect(); return box.bottom > -300 && box.top < innerHeight + 600; };

// What the reader sees first, then the rest while the browser is idle, nearest to the view first.
async function drawInView() {
  for (const entry of figures) if (!entry.drawn && inView(entry)) await render(entry);
}
async function drawTheRest() {
  while (true) {
    await pause();
    await queue(async () => {
      await drawInView();
      const next = figures.find(({ drawn }) => !drawn) ?? null;
      if (next) await render(next);
    });
    if (figures.every(({ drawn }) => drawn)) break;
  }
  for (const entry of figures) { await pause(); await queue(() => pictureForPaper(entry)); }
}

function fail(error) {
  const box = $('#trouble');
  box.hidden = false;
  box.textContent = `The figures could not be drawn: ${error.message}.`;
  document.documentElement.dataset.ready = 'failed';
  console.error(error);
}

// A measured range as a shaded band over [from, to].
function bandTraces(from, to, low, high, name) {
  const common = { x: [from, to], mode: 'lines', line: { width: 0 }, hoverinfo: 'skip', legendgroup: name };
  return [{ ...common, y: [low, low], showlegend: false },
          { ...common, y: [high, high], fill: 'tonexty', fillcolor: css('--band'), name }];
}

// ---------------------------------------------------------------- start
// Tables stand in the page as HTML; their links give the same text as the file beside it.
function offerTables() {
  const quoted = (text) => /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  for (const root of document.querySelectorAll('.datatable')) {
    const link = $('a.csv', root);
    const cells = (row) => [...row.cells].map((cell) => quoted(cell.dataset.value ?? cell.textContent)).join(',');
    if (link) offerCsv(link, link.getAttribute('download'), () => [...root.querySelectorAll('tr')].map(cells).join('\n') + '\n');
  }
}

// Draws what each `prepare` describes with figure(), and again when theme, width or medium change. A page may have
// several scripts that call this; it begins when the last of them has been read.
const preparations = [];
function start(prepare) {
  if (preparations.push(prepare) === 1) queueMicrotask(begin);
}

async function begin() {
  try {
    if (typeof DecompressionStream === 'undefined') throw new Error('this browser is too old to unpack the figures (it needs DecompressionStream, 2023 or newer)');
    offerTables();
    const code = document.createElement('script');
    code.textContent = await inflateText('charts', 'gzip') + '\nwindow.Plotly = Plotly;';
    document.head.append(code);
    for (const prepare of preparations) await prepare();
    await queue(drawInView);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', renderAll);
    matchMedia('(max-width: 619px)').addEventListener('change', renderAll);
    addEventListener('scroll', () => queue(drawInView), { passive: true });
    // Panels side by side share the width in pixels.
    let settling = 0;
    addEventListener('resize', () => {
      clearTimeout(settling);
      settling = setTimeout(() => queue(async () => { for (const entry of figures) if (entry.drawn && !fixedWidth && entry.plot.clientWidth !== entry.width) await render(entry); }), 250);
    });
    // Paper is white. No await between here and the last figure but for what is ready at once: the browser waits for no more.
    addEventListener('beforeprint', () => { document.documentElement.dataset.theme = 'light'; fixedWidth = kPaperWidth; renderAll(); });
    addEventListener('afterprint', () => { delete document.documentElement.dataset.theme; fixedWidth = 0; renderAll(); });
    if (document.documentElement.dataset.ready !== 'failed') document.documentElement.dataset.ready = 'yes';
    await drawTheRest();
    document.documentElement.dataset.complete = 'yes';
  } catch (error) {
    fail(error);
  }
}

return { $, narrow, onPaper, inflateText, inflateNumbers, table, times, unique, whereEqual, finite, largest, smallest, digits, roundDown, css, transparent, plain,
         kDepthScale, axis, sceneAxis, colourBar, figure, figures, picture, bandTraces, start };
})();
