// SPDX-License-Identifier: BSD-3-Clause
// check_study.mjs <chromium> <report.html>: the page of make_study.cpp as its readers see it; fails, saying why.
import { visit } from './visit.mjs';

const [chromium, file] = process.argv.slice(2);
const page = await visit(chromium, file), { browser, check } = page;
const kFigures = 15;
const texts = (selector) => browser.evaluate(`[...document.querySelectorAll('${selector}')].map((e) => e.textContent)`);

try {
  await page.open(1280, false, kFigures);
  // Every figure and table of the paper has a badge in either reading, and so has every claim.
  const shown = await texts('#table-figures-and-tables tbody td:first-child');
  check(shown.join() === 'Fig. 7,Fig. 8,Fig. 9,Fig. 10,Fig. 11,Fig. 12,Fig. 13,Fig. 14,Fig. 15,Fig. 16,Fig. 17,Fig. 18,Table 3,Table 4', `figures and tables: ${shown}`);
  for (const table of ['figures-and-tables', 'claims']) {
    const rows = await texts(`#table-${table} tbody tr`), marks = await texts(`#table-${table} .mark`);
    check(marks.length === 2 * rows.length, `${table}: ${marks.length} badges in ${rows.length} rows`);
    for (const kind of ['✓ reproduced', '✗ not reproduced']) check(marks.includes(kind), `${table}: no badge '${kind}'`);
  }
  const row = (id) => browser.evaluate(`[...document.querySelectorAll('#table-claims tbody tr')].find((r) => r.cells[0].textContent === '${id}').innerText`);
  check(/✓ reproduced[\s\S]*✗ not reproduced/.test(await row('V17')), `V17: ${await row('V17')}`);
  // The paper's numbers stand beside ours.
  check((await texts('#fig-fig15-volumes .legendtext')).filter((t) => /^paper, eq\. 1[3-7]$/.test(t)).length === 5, 'fig15: an equation is missing');
  check((await texts('#fig-fig10-depths .legendtext')).includes('paper: range'), 'fig10: the range of the paper is missing');
  check(await browser.evaluate('document.querySelectorAll("#fig-fig12-depth-boxes .boxlayer path.box").length') === 20, 'fig12: not ten boxes in either reading');
  check(await browser.evaluate('document.querySelectorAll("#fig-fig14-contours-paper .scatterlayer path.js-line").length') >= 24, 'fig14: not 24 contours');
  const csv = (await page.save('#fig-fig07-mesh-size a.csv', 'fig07-mesh-size.csv')).toString();
  check(csv.startsWith('panel,series,mesh_size_mm,'), `fig07-mesh-size.csv begins '${csv.slice(0, 60)}'`);
  const { pages } = await page.print();
  check(pages >= 8 && pages <= 40, `printed: ${pages} pages`);
  await page.open(390, false, kFigures);
  check(page.dialogs === 0, 'text of the page ran as a script');
} catch (error) {
  page.failures.push(String(error));
}
await page.finish('The published study is complete at 1280 and 390 px and on paper, and loaded nothing.');
