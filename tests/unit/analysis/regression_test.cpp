// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/analysis/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/random.h"

// Reference values: NumPy 1.24 (linalg.lstsq, linalg.inv) and SciPy 1.10.1 (stats.t).

namespace abradem::analysis {
namespace {

void expect_near(const std::vector<double>& values, const std::vector<double>& known, double relative) {
  ASSERT_EQ(values.size(), known.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], known[i], relative * std::abs(known[i])) << i;
}

const std::vector<double> kX{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
const std::vector<double> kY{2.1, 3.9, 6.2, 7.8, 10.3, 12.1, 13.7, 16.4, 18.0, 19.7, 22.3, 23.8};

TEST(PolynomialFit, OfALineAgreesWithNumPy) {
  const PolynomialFit fit = fit_polynomial(kX, kY, {.degree = 1});
  expect_near(fit.coefficients, {2.0692307692307614, 1.9919580419580425}, 1e-13);
  expect_near(fit.errors, {0.13878959453436365, 0.021373333955465427}, 1e-12);
  expect_near(fit.low, {1.7599882814002852, 1.9443352861758485}, 1e-10);
  expect_near(fit.p, {3.7064996500718246e-08, 4.951434983250912e-16}, 1e-9);
  EXPECT_NEAR(fit.residual_sd, 0.25558790038883833, 1e-13);
  EXPECT_NEAR(fit.r_squared, 0.9988500354305173, 1e-14);
  EXPECT_EQ(fit.df, 10);
  EXPECT_NEAR(fit.model.t, 2.2281388519649385, 1e-10);
  const Estimate mean = fit.mean_at(15.0), one_more = fit.prediction_at(15.0);
  EXPECT_NEAR(mean.value, 31.948601398601397, 1e-12);
  EXPECT_NEAR(mean.high - mean.value, 0.4813590431029749, 1e-10);
  EXPECT_NEAR(mean.value - mean.low, 0.4813590431029749, 1e-10);
  EXPECT_NEAR(one_more.high - one_more.value, 0.7456675335178216, 1e-10);
  EXPECT_NEAR(fit(15.0), mean.value, 1e-12);
}

TEST(PolynomialFit, OfAParabolaAgreesWithNumPy) {
  const PolynomialFit fit = fit_polynomial(kX, kY, {.degree = 2});
  expect_near(fit.coefficients, {2.021153846153825, 2.020804195804196, -0.002622377622377048}, 1e-11);
  expect_near(fit.errors, {0.19779817593437174, 0.08359643942802243, 0.007322510934194926}, 1e-11);
  expect_near(fit.p, {2.988777755751004e-06, 1.6970114919181362e-09, 0.728505293300936}, 1e-9);
  EXPECT_NEAR(fit.r_squared, 0.9988661926696915, 1e-13);
  EXPECT_NEAR(fit.mean_at(15.0).high - fit(15.0), 1.3947478841359455, 1e-10);
  EXPECT_NEAR(fit.prediction_at(15.0).high - fit(15.0), 1.5203744908262886, 1e-10);
}

TEST(PolynomialFit, ThroughTheOriginAgreesWithNumPy) {
  const PolynomialFit line = fit_polynomial(kX, kY, {.degree = 1, .through_origin = true});
  EXPECT_EQ(line.coefficients[0], 0.0);
  EXPECT_NEAR(line.coefficients[1], 2.2618577075098814, 1e-13);
  EXPECT_EQ(line(0.0), 0.0);
  const std::vector<double> x(kX.begin() + 1, kX.end()), y(kY.begin() + 1, kY.end());
  const PolynomialFit fit = fit_polynomial(x, y, {.degree = 2, .through_origin = true});
  expect_near(fit.coefficients, {0.0, 2.7216062831640717, -0.05340513757599179}, 1e-12);
  EXPECT_NEAR(fit.errors[1], 0.11466052735577915, 1e-13);
  EXPECT_EQ(fit.df, 9);
  EXPECT_TRUE(std::isnan(fit.p[0]));
}

TEST(PolynomialFit, OfExactPolynomialsIsExactToRoundOff) {
  // Also far from 0 and with a narrow spread, where plain powers of x would be dependent to eight digits.
  for (const double offset : {0.0, 1000.0}) {
    std::vector<double> x, y;
    for (int i = 0; i < 20; ++i) {
      x.push_back(offset + 0.5 * i);
      y.push_back(3.0 - 2.0 * x.back() + 0.25 * x.back() * x.back());
    }
    const PolynomialFit fit = fit_polynomial(x, y, {.degree = 2});
    for (const double at : {x.front(), x.back(), offset + 25.0})
      EXPECT_NEAR(fit(at) / (3.0 - 2.0 * at + 0.25 * at * at), 1.0, 1e-14) << at;
    EXPECT_NEAR(fit.coefficients[2], 0.25, 1e-12 * (1.0 + offset));
    EXPECT_NEAR(fit.r_squared, 1.0, 1e-14);
    EXPECT_LT(fit.residual_sd, 1e-14 * y.back());
  }
}

TEST(PolynomialFit, DoesNotDependOnUnits) {
  std::vector<double> micro;
  for (const double y : kY) micro.push_back(1e-15 * y);
  const PolynomialFit a = fit_polynomial(kX, kY, {.degree = 2}), b = fit_polynomial(kX, micro, {.degree = 2});
  EXPECT_NEAR(a.r_squared, b.r_squared, 1e-13);
  EXPECT_NEAR(a.p[2], b.p[2], 1e-10);
  EXPECT_NEAR(b.coefficients[1] * 1e15, a.coefficients[1], 1e-12);
}

TEST(PolynomialFit, BandsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kSamples = 2000;
  int held = 0, predicted = 0;
  for (int k = 0; k < kSamples; ++k) {
    core::RandomStream random(11, static_cast<std::uint64_t>(k));
    const auto noise = [&] {  // sum of 12 uniform numbers: normal enough, variance 1
      double sum = -6.0;
      for (int i = 0; i < 12; ++i) sum += random.uniform();
      return sum;
    };
    std::vector<double> y;
    for (const double x : kX) y.push_back(1.0 + 0.5 * x + noise());
    const PolynomialFit fit = fit_polynomial(kX, y, {.degree = 1});
    const Estimate mean = fit.mean_at(14.0), one_more = fit.prediction_at(14.0);
    const double another = 8.0 + noise();
    held += mean.low <= 8.0 && 8.0 <= mean.high;
    predicted += one_more.low <= another && another <= one_more.high;
  }
  EXPECT_NEAR(held / static_cast<double>(kSamples), 0.95, 0.015);
  EXPECT_NEAR(predicted / static_cast<double>(kSamples), 0.95, 0.015);
}

TEST(PolynomialFit, ClaimsNothingWithoutDegreesOfFreedom) {
  const std::vector<double> x{1.0, 2.0}, y{1.0, 3.0};
  const PolynomialFit fit = fit_polynomial(x, y);
  EXPECT_NEAR(fit.coefficients[1], 2.0, 1e-14);
  EXPECT_TRUE(std::isnan(fit.errors[1]) && std::isnan(fit.p[1]) && std::isnan(fit.mean_at(1.5).low));
  // Equal values: nothing varies, so nothing is explained.
  EXPECT_TRUE(std::isnan(fit_polynomial(kX, std::vector<double>(12, 0.1)).r_squared));
}

TEST(PolynomialFit, RefusesWhatCannotBeFitted) {
  const std::vector<double> same(5, 2.0), y{1, 2, 3, 4, 5};
  EXPECT_THROW((void)fit_polynomial(same, y), InputError);
  EXPECT_THROW((void)fit_polynomial(std::vector{1.0, 2.0}, y), InputError);
  EXPECT_THROW((void)fit_polynomial(std::vector{1.0, 2.0}, std::vector{1.0, 2.0}, {.degree = 2}), InputError);
  EXPECT_THROW((void)fit_polynomial(kX, kY, {.degree = 0}), InputError);
  EXPECT_THROW((void)fit_polynomial(kX, kY, {.degree = 1, .confidence = 1.0}), InputError);
  std::vector<double> bad = kY;
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)fit_polynomial(kX, bad), InputError);
}

const std::vector<double> kN{1, 2, 3, 4.5, 6, 7, 9, 10};
const std::vector<double> kV{.31, .58, .93, 1.35, 1.87, 2.13, 2.79, 3.05};

TEST(IncrementFit, AgreesWithNumPy) {
  const IncrementFit line = fit_increments(kN, kV, 1), curve = fit_increments(kN, kV, 2);
  EXPECT_NEAR(line.coefficients[0], 0.305, 1e-14);  // by weights of 1/dn the slope is V(10)/10
  EXPECT_NEAR(line.errors[0], 0.013156566348984787, 1e-14);
  EXPECT_NEAR(line.residual_sd, 0.04160471584991765, 1e-14);
  EXPECT_NEAR(line.low[0], 0.2738896641511645, 1e-10);
  EXPECT_NEAR(line.mean_at(12.0).high - line(12.0), 0.37332403018602556, 1e-9);
  // One more V(12): sqrt(0.3733^2 + t^2 sigma^2 12)
  EXPECT_NEAR(line.prediction_at(12.0).high - line(12.0),
              std::hypot(0.37332403018602556, 2.3646242510102993 * 0.04160471584991765 * std::sqrt(12.0)),
              1e-9);
  EXPECT_NEAR(line.r_squared, 0.0, 1e-12);
  expect_near(curve.coefficients, {0.309284621270084, -0.0004284621270084155}, 1e-10);
  expect_near(curve.errors, {0.02856439482971242, 0.002479878933549531}, 1e-12);
  expect_near(curve.p, {3.6742438321860925e-05, 0.8685089023083823}, 1e-9);
  EXPECT_NEAR(curve(12.0), 3.6497169089517962, 1e-12);
  EXPECT_NEAR(curve.r_squared, 0.004950594039711875, 1e-12);
  EXPECT_NEAR(curve.rate(5.0), 0.309284621270084 - 10.0 * 0.0004284621270084155, 1e-13);
}

TEST(IncrementFit, OfAnExactLawIsExact) {
  std::vector<double> n, V;
  for (int i = 3; i <= 12; ++i) {
    n.push_back(i);
    V.push_back(0.7 + 0.2 * (i - 2) + 0.01 * (i * i - 4));
  }
  const IncrementFit fit = fit_increments(n, V, 2, 0.95, 2.0, 0.7);
  expect_near(fit.coefficients, {0.2, 0.01}, 1e-12);
  EXPECT_NEAR(fit(20.0), 0.7 + 3.6 + 3.96, 1e-12);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
}

TEST(IncrementFit, RefusesPlacesThatDoNotAscend) {
  EXPECT_THROW((void)fit_increments(std::vector{1.0, 1.0}, std::vector{0.1, 0.2}, 1), InputError);
  EXPECT_THROW((void)fit_increments(std::vector{0.0, 1.0}, std::vector{0.1, 0.2}, 1), InputError);
  EXPECT_THROW((void)fit_increments({}, {}, 1), InputError);
  EXPECT_THROW((void)fit_increments(kN, kV, 3), InputError);
}

}  // namespace
}  // namespace abradem::analysis
