// SPDX-License-Identifier: BSD-3-Clause
// check_report.mjs <chromium> <report.html> <figures>: opens the page as a reader does and fails, saying why, when
// a figure is missing or empty, the console complains, anything is loaded, or the page is wider than a phone.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

const [chromium, file, wanted] = process.argv.slice(2);
const address = pathToFileURL(resolve(file)).href, failures = [];
const check = (good, what) => { if (!good) failures.push(what); };
const browser = await launch(chromium);
let dialogs = 0;
browser.listen((method, p) => {
  if (method === 'Runtime.exceptionThrown') failures.push(`exception: ${p.exceptionDetails.exception?.description ?? p.exceptionDetails.text}`);
  if (method === 'Runtime.consoleAPICalled' && ['error', 'assert'].includes(p.type)) failures.push(`console.${p.type}: ${p.args.map((a) => a.value ?? a.description).join(' ')}`);
  if (method === 'Log.entryAdded' && p.entry.level === 'error') failures.push(`log: ${p.entry.text}`);
  if (method === 'Network.requestWillBeSent' && p.request.url !== address && !/^(data|blob):/.test(p.request.url)) failures.push(`request: ${p.request.url}`);
  if (method === 'Page.javascriptDialogOpening') { ++dialogs; browser.send('Page.handleJavaScriptDialog', { accept: true }); }
});

// What a figure holds: marks drawn, axis titles, a link to its data.
const survey = `[...document.querySelectorAll('figure')].map((f) => ({
  id: f.id,
  plotted: Boolean(f.querySelector('.js-plotly-plot .main-svg')),
  marks: f.querySelectorAll('.js-plotly-plot :is(.scatterlayer path.js-line, .barlayer path, .boxlayer path.box, .heatmaplayer image)').length,
  canvas: f.querySelector('.gl-container canvas')?.width ?? 0,
  empty: f.querySelector('.empty')?.textContent ?? '',
  titles: [...f.querySelectorAll('.xtitle, .ytitle')].map((t) => t.textContent),
  link: f.querySelector('a.csv').download,
}))`;

async function open(width, dark) {
  await browser.resize(width, 900, dark);
  await browser.send('Page.navigate', { url: address });
  await browser.until('document.documentElement?.dataset.complete || document.documentElement?.dataset.ready === "failed"', 120);
  const view = `${width} px${dark ? ', dark' : ''}`;
  check(await browser.evaluate('document.documentElement.dataset.ready') === 'yes', `${view}: ${await browser.evaluate('document.getElementById("trouble").textContent')}`);
  const wide = await browser.evaluate('document.documentElement.scrollWidth');
  check(wide <= width, `${view}: the page is ${wide} px wide`);
  const figures = await browser.evaluate(survey);
  check(figures.filter((f) => f.plotted).length === Number(wanted), `${view}: ${figures.filter((f) => f.plotted).length} figures, expected ${wanted}`);
  for (const figure of figures) {
    check(figure.plotted !== Boolean(figure.empty), `${view}: ${figure.id} neither plots nor says why`);
    if (!figure.plotted) continue;
    check(figure.marks > 0 || figure.canvas > 0, `${view}: ${figure.id} is blank`);
    for (const title of figure.titles) check(/\[.+\]$/.test(title), `${view}: axis '${title}' of ${figure.id} has no unit`);
    check(figure.titles.length === 2 || figure.canvas > 0, `${view}: ${figure.id} lacks an axis title`);
    check(figure.link.endsWith('.csv'), `${view}: ${figure.id} has no CSV`);
  }
}

try {
  await open(1280, false);
  if (Number(wanted) > 0) {
    // The 3D view must show the groove: pixels of the deepest colour's blues, not a blank canvas.
    const { data } = await browser.send('Page.captureScreenshot', { format: 'png', clip: { ...await browser.evaluate(
      '(({ x, y, width, height }) => ({ x, y: y + scrollY, width: width * 0.8, height }))(document.querySelector("#fig-surface .plot").getBoundingClientRect())'), scale: 1 } });
    const dark = await browser.evaluate(`(async () => {
      const image = new Image();
      image.src = 'data:image/png;base64,${data}';
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height), pen = canvas.getContext('2d', { willReadFrequently: true });
      pen.drawImage(image, 0, 0);
      const p = pen.getImageData(0, 0, image.width, image.height).data;
      let count = 0;
      for (let k = 0; k < p.length; k += 4) if (p[k + 2] > p[k] + 40 && p[k] < 110) ++count;
      return count;
    })()`);
    check(dark > 500, `the worn surface shows ${dark} pixels of worn metal, expected more than 500`);
    // Every control redraws its figure.
    for (const [figure, control, value] of [['surface', 'view', 'close'], ['surface', 'exaggeration', '10'], ['profiles', 'revolution', '1'], ['force', 'quantity', 'overlap']]) {
      const before = await browser.evaluate(`JSON.stringify([...document.querySelector('#fig-${figure} .plot').data].map((t) => [t.y.length, t.y[40], t.z?.length, t.z?.[40]])) + document.querySelector('#fig-${figure} .words').textContent`);
      await browser.evaluate(`(() => { const c = document.querySelector('#fig-${figure} [data-control=${control}]'); c.value = '${value}'; c.dispatchEvent(new Event('change')); })()`);
      await browser.until(`JSON.stringify([...document.querySelector('#fig-${figure} .plot').data].map((t) => [t.y.length, t.y[40], t.z?.length, t.z?.[40]])) + document.querySelector('#fig-${figure} .words').textContent !== ${JSON.stringify(before)}`, 60);
    }
    // A link gives the table that the figure shows.
    const csv = await browser.evaluate(`(async () => {
      const link = document.querySelector('#fig-volume a.csv');
      link.addEventListener('click', (event) => event.preventDefault());
      link.click();
      return [link.download, link.href.startsWith('blob:')];
    })()`);
    check(csv[0] === 'revolutions.csv' && csv[1], `the CSV link of the volume gives ${csv}`);
  }
  await open(390, false);
  await open(390, true);
  check(dialogs === 0, 'text of the case ran as a script');
  check(!/(src|href)="(https?:)?\/\//.test(readFileSync(file, 'utf8')), 'the page links to the network');
} catch (error) {
  failures.push(String(error));
} finally {
  await browser.close();
}
for (const failure of failures) console.error(`FAIL ${failure}`);
if (failures.length === 0) console.log('The report is complete at 1280 and 390 px and loaded nothing.');
process.exit(failures.length ? 1 : 0);
