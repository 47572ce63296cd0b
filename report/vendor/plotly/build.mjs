// SPDX-License-Identifier: BSD-3-Clause
// Bundles entry.js into plotly-abradem.min.js and writes LICENSES.txt, the notices of every package that went
// in. plotly's own custom-bundle script lives in its repository, not in its npm package, so this repeats its
// esbuild settings.
import { readFile, readdir, writeFile } from 'node:fs/promises';
import { build } from 'esbuild';
import { environmentPlugin } from 'esbuild-plugin-environment';
import { glsl } from 'esbuild-plugin-glsl';
import inlineCss from 'esbuild-plugin-inline-css';

const outfile = 'plotly-abradem.min.js';

// The attribute tables carry their documentation; plotly's release build strips it, and so do we.
const withoutDescriptions = {
  name: 'without-descriptions',
  setup(builder) {
    builder.onLoad({ filter: /plotly\.js[\\/]src[\\/].*\.js$/ }, async ({ path }) => {
      const source = await readFile(path, 'utf8');
      return {
        loader: 'js',
        contents: source
          .replace(/\n\s*description: \[[^\]]*?\]\s*\.join\([^)]*\),?/g, '')
          .replace(/\n\s*description:\s*\n?\s*'(?:[^'\\\n]|\\.)*',?(?=\n)/g, ''),
      };
    });
  },
};

// The core imports the style sheet of the map traces, which the report has none of.
const withoutMapStyles = {
  name: 'without-map-styles',
  setup(builder) {
    builder.onLoad({ filter: /maplibre-gl\.css$/ }, () => ({ contents: '', loader: 'js' }));
  },
};

const { metafile } = await build({
  entryPoints: ['entry.js'],
  outfile,
  format: 'iife',
  globalName: 'Plotly',
  bundle: true,
  minify: true,
  target: 'es2018',
  charset: 'utf8',
  legalComments: 'none',
  banner: { js: '/* plotly.js 3.7.0, custom bundle (bar, box, heatmap, histogram, mesh3d, scatter); MIT and others, see LICENSES.txt */' },
  alias: { stream: 'stream-browserify' },
  define: { global: 'window', 'define.amd': 'false' },
  plugins: [withoutMapStyles, withoutDescriptions, inlineCss(), glsl({ minify: true }),
            environmentPlugin({ NODE_DEBUG: false })],
  metafile: true,
});

const packages = new Set();
for (const [input, { bytesInOutput }] of Object.entries(metafile.outputs[outfile].inputs)) {
  const name = input.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[0];
  if (name && bytesInOutput > 0) packages.add(name);
}
let notices = 'plotly-abradem.min.js holds code of these packages.\n';
for (const folder of [...packages].sort()) {
  const { name, version, license } = JSON.parse(await readFile(`${folder}/package.json`, 'utf8'));
  notices += `\n${'='.repeat(78)}\n${name} ${version}: ${license}\n`;
  const file = (await readdir(folder)).find((f) => /^(licen[cs]e|copying)/i.test(f));
  if (file) notices += `\n${(await readFile(`${folder}/${file}`, 'utf8')).trim()}\n`;
}
await writeFile('LICENSES.txt', notices);
