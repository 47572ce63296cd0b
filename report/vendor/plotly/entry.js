// SPDX-License-Identifier: BSD-3-Clause
// The trace types the report draws, and no others (scatter comes with the core).
'use strict';
const Plotly = require('plotly.js/lib/core');
Plotly.register([
  require('plotly.js/lib/bar'),
  require('plotly.js/lib/box'),
  require('plotly.js/lib/heatmap'),
  require('plotly.js/lib/histogram'),
  require('plotly.js/lib/mesh3d'),
]);
module.exports = Plotly;
