// SPDX-License-Identifier: BSD-3-Clause
// Opens a page as a reader does and notes as failures what no page may do: complain in the console, load anything,
// be wider than its window, leave a figure blank, an axis without a unit, a figure without its links.
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

// What a figure holds: marks drawn, axis titles, links to its data and pictures.
const survey = `[...document.querySelectorAll('figure')].map((f) => ({
  id: f.id,
  plotted: Boolean(f.querySelector('.js-plotly-plot .main-svg')),
  marks: f.querySelectorAll('.js-plotly-plot :is(.scatterlayer path.js-line, .scatterlayer path.point, .barlayer path, .boxlayer path.box, .heatmaplayer image)').length,
  canvas: f.querySelector('.gl-container canvas')?.width ?? 0,
  empty: f.querySelector('.empty')?.textContent ?? '',
  titles: [...f.querySelectorAll('.xtitle, .ytitle, .x2title, .y2title')].map((t) => t.textContent),
  caption: f.querySelector('figcaption').textContent,
  link: f.querySelector('a.csv').download,
  buttons: [...f.querySelectorAll('.links button')].map((b) => b.textContent).join(),
}))`;

export async function visit(chromium, file) {
  const address = pathToFileURL(resolve(file)).href, failures = [], browser = await launch(chromium);
  const check = (good, what) => { if (!good) failures.push(what); };
  const downloads = mkdtempSync(join(tmpdir(), 'report-saved-'));
  const page = { browser, failures, check, dialogs: 0, plots: 0 };
  browser.listen((method, p) => {
    if (method === 'Runtime.exceptionThrown') failures.push(`exception: ${p.exceptionDetails.exception?.description ?? p.exceptionDetails.text}`);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'assert'].includes(p.type)) failures.push(`console.${p.type}: ${p.args.map((a) => a.value ?? a.description).join(' ')}`);
    if (method === 'Log.entryAdded' && p.entry.level === 'error') failures.push(`log: ${p.entry.text}`);
    if (method === 'Network.requestWillBeSent' && p.request.url !== address && !/^(data|blob):/.test(p.request.url)) failures.push(`request: ${p.request.url}`);
    if (method === 'Page.javascriptDialogOpening') { ++page.dialogs; browser.send('Page.handleJavaScriptDialog', { accept: true }); }
  });

  // Opens the page at a width and waits until every figure is drawn.
  page.open = async (width, dark, wanted) => {
    await browser.resize(width, 900, dark);
    await browser.send('Page.navigate', { url: address });
    await browser.until('document.documentElement?.dataset.complete || document.documentElement?.dataset.ready === "failed"', 120);
    const view = `${width} px${dark ? ', dark' : ''}`;
    check(await browser.evaluate('document.documentElement.dataset.ready') === 'yes', `${view}: ${await browser.evaluate('document.getElementById("trouble").textContent')}`);
    const wide = await browser.evaluate('document.documentElement.scrollWidth');
    check(wide <= width, `${view}: the page is ${wide} px wide`);
    const figures = await browser.evaluate(survey);
    page.plots = figures.filter((f) => f.plotted).length;
    check(page.plots === Number(wanted), `${view}: ${page.plots} figures, expected ${wanted}`);
    figures.forEach((figure, n) => {
      check(figure.plotted !== Boolean(figure.empty), `${view}: ${figure.id} neither plots nor says why`);
      check(figure.caption.startsWith(`Figure ${n + 1}. `), `${view}: the caption of ${figure.id} is '${figure.caption}'`);
      if (!figure.plotted) return;
      check(figure.marks > 0 || figure.canvas > 0, `${view}: ${figure.id} is blank`);
      for (const title of figure.titles) check(/\[.+\]$/.test(title), `${view}: axis '${title}' of ${figure.id} has no unit`);
      check(figure.titles.length >= 2 || figure.canvas > 0, `${view}: ${figure.id} lacks an axis title`);
      check(figure.link.endsWith('.csv'), `${view}: ${figure.id} has no CSV`);
      check(figure.buttons === 'SVG,PNG', `${view}: ${figure.id} offers '${figure.buttons}'`);
    });
  };

  // What a figure's link or button saves, as bytes.
  page.save = async (selector, name) => {
    await browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: downloads });
    await browser.evaluate(`document.querySelector('${selector}').click()`);
    for (const end = Date.now() + 60000; Date.now() < end;) {
      try {
        const bytes = readFileSync(join(downloads, name));
        if (bytes.length) return bytes;
      } catch { /* not there yet */ }
      await new Promise((wait) => setTimeout(wait, 100));
    }
    throw new Error(`${selector} saved no ${name}`);
  };

  // Paper must show as many figures as the screen: each takes room and lies within the sheet's width.
  page.print = async () => {
    const { data } = await browser.send('Page.printToPDF', { printBackground: true, paperWidth: 8.27, paperHeight: 11.69, preferCSSPageSize: true });
    const pdf = Buffer.from(data, 'base64').toString('latin1');
    return { pages: (pdf.match(/\/Type\s*\/Page\b/g) ?? []).length, size: pdf.length };
  };

  page.finish = async (message) => {
    await browser.close();
    rmSync(downloads, { recursive: true, force: true });
    for (const failure of failures) console.error(`FAIL ${failure}`);
    if (failures.length === 0) console.log(message);
    process.exit(failures.length ? 1 : 0);
  };
  check(!/(src|href)="(https?:)?\/\//.test(readFileSync(file, 'utf8')), 'the page links to the network');
  return page;
}
