// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/levelling.h"

#include <fmt/core.h>

#include <cmath>

#include "abradem/analysis/regression.h"
#include "abradem/core/error.h"

namespace abradem::analysis {

Levelled level(std::span<const ProfilePoint> profile, Baseline baseline, double shoulder) {
  if (profile.size() < 4)
    throw InputError(fmt::format("{} points; a section and its shoulders need 4 or more", profile.size()));
  const double first = profile.front().radius, last = profile.back().radius, middle = 0.5 * (first + last);
  if (!(shoulder > 0.0) || 2.0 * shoulder >= last - first)
    throw InputError(
        fmt::format("shoulders of {:g} mm on a section of {:g} mm; both together must be shorter",
                    1e3 * shoulder, 1e3 * (last - first)));
  std::vector<double> x, y;
  std::size_t left = 0;
  for (const ProfilePoint& p : profile) {
    if (p.radius > first + shoulder && p.radius < last - shoulder) continue;
    x.push_back(p.radius - middle);
    y.push_back(p.height);
    left += p.radius <= first + shoulder ? 1 : 0;
  }
  if (left < 2 || x.size() - left < 2)
    throw InputError(fmt::format("{} and {} points on shoulders of {:g} mm; 2 on each are needed", left,
                                 x.size() - left, 1e3 * shoulder));

  Levelled out{.profile = {profile.begin(), profile.end()}};
  out.shoulder_points = x.size();
  if (baseline == Baseline::line) {
    const PolynomialFit fit = fit_polynomial(x, y, {.degree = 1});
    out.offset = fit.coefficients[0];
    out.tilt = fit.coefficients[1];
  } else if (baseline == Baseline::mean) {
    for (const double height : y) out.offset += height / static_cast<double>(y.size());
  }
  for (ProfilePoint& p : out.profile) p.height -= out.offset + out.tilt * (p.radius - middle);
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double above = y[i] - out.offset - out.tilt * x[i];
    squares += above * above;
  }
  out.roughness = std::sqrt(squares / static_cast<double>(x.size()));
  return out;
}

}  // namespace abradem::analysis
