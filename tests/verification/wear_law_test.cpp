// SPDX-License-Identifier: BSD-3-Clause
// Laws fitted to many wear tests: a published data set against NumPy and SciPy, known exponents, the rate at
// which true Archard is rejected, and designs that cannot tell.
// Reference values: NumPy 1.24.2 (linalg.lstsq, linalg.inv), SciPy 1.10.1 (stats.f, t, chi2, shapiro; its
// quantile of t with 4 degrees of freedom is 2.3e-9 low: the root of its distribution
// function, 2.13184678632665, instead).
#include "abradem/study/wear_law.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "abradem/core/error.h"
#include "abradem/core/random.h"
#include "abradem/io/wear_tests.h"

namespace abradem::study {
namespace {

/// Both sides are least squares in double precision on 20 values; SciPy's Shapiro-Wilk is single precision.
constexpr double kSame = 1e-9, kSingle = 1e-5;

void expect_close(double value, double expected, double relative) {
  EXPECT_NEAR(value, expected, relative * std::abs(expected));
}

/// V = k F^p s^q exp(noise), at every pair of these forces and distances.
WearTests crossed(double k, double p, double q, double noise, std::uint64_t seed,
                  const std::vector<double>& forces = {5, 10, 20, 50},
                  const std::vector<double>& distances = {100, 300, 1000}) {
  core::RandomStream random(seed);
  const boost::math::normal gauss;
  WearTests t;
  for (const double f : forces)
    for (const double s : distances) {
      const double z = quantile(gauss, random.uniform(0x1p-54, 1.0));
      t.force.push_back(f);
      t.distance.push_back(s);
      t.volume.push_back(k * std::pow(f, p) * std::pow(s, q) * std::exp(noise * z));
    }
  return t;
}

TEST(WearLaw, OfPublishedTestsAgreesWithSciPyAndIsNotArchards) {
  struct Reference {
    const char* material;
    double p, p_low, p_high, k_mm3, F, F_p, error, error_archard, studentised, outlier_p, equal_scatter,
        bend_F, bend_p, lack_F, lack_p, shapiro_p, alpha, alpha_low, alpha_high;
  };
  constexpr Reference kReference[] = {{"M1",
                                       1.737808318195422,
                                       1.4964378325592422,
                                       1.9791788038316018,
                                       0.018745526672986394,
                                       41.24189767102347,
                                       4.804620222225817e-06,
                                       0.3540994789996788,
                                       0.8068902449762978,
                                       -2.951115397639431,
                                       0.1787638455778591,
                                       0.7162194262280257,
                                       0.46110436667580945,
                                       0.5062488663508967,
                                       0.18270661269952168,
                                       0.90648292950318,
                                       0.6257334351539612,
                                       1.1026048508589892e-13,
                                       8.661519890616163e-14,
                                       1.4036075336557228e-13},
                                      {"M2",
                                       1.5354042578689728,
                                       1.3027976246846595,
                                       1.7680108910532861,
                                       0.010852314217826618,
                                       23.38510504870555,
                                       0.00013262243092466926,
                                       0.3245205814585276,
                                       0.5147426574481362,
                                       -2.481386032014635,
                                       0.4767593058266322,
                                       0.9371722233519695,
                                       1.529078212572636,
                                       0.23306286165952153,
                                       0.523121299124963,
                                       0.6729360154397304,
                                       0.9634314775466919,
                                       1.965358408852249e-14,
                                       1.6183328456641618e-14,
                                       2.3867980468881997e-14},
                                      {"M3",
                                       1.5511244692941544,
                                       1.2933501904199098,
                                       1.808898748168399,
                                       0.03196239357191858,
                                       20.17623373491208,
                                       0.0002820576513485454,
                                       0.3667693195317155,
                                       0.6002108751333946,
                                       -2.5151785165814795,
                                       0.4449060060014248,
                                       0.9012590287896063,
                                       0.15608475128556484,
                                       0.6977002371388498,
                                       0.05887811469477328,
                                       0.9805512228401659,
                                       0.5088052749633789,
                                       7.990914693202165e-14,
                                       6.497232086962029e-14,
                                       9.827987792243293e-14}};
  const std::vector<WearTests> materials =
      io::read_wear_tests(ABRADEM_SOURCE_DIR "/cases/data/ptfe-pin-on-disc.csv");
  ASSERT_EQ(materials.size(), 3U);
  std::vector<WearLawFit> fits;
  for (std::size_t m = 0; m < 3; ++m) {
    const Reference& expected = kReference[m];
    SCOPED_TRACE(expected.material);
    fits.push_back(fit_wear_law(materials[m]));
    const WearLawFit& r = fits.back();
    EXPECT_EQ(r.tests.material, expected.material);
    EXPECT_EQ(r.tests.volume.size(), 20U);
    EXPECT_EQ(r.identifiable, Identifiable::force);
    EXPECT_FALSE(r.q);
    ASSERT_TRUE(r.p && r.k && r.curvature && r.lack_of_fit);
    expect_close(r.p->value, expected.p, kSame);
    expect_close(r.p->low, expected.p_low, kSame);
    expect_close(r.p->high, expected.p_high, kSame);
    expect_close(1e9 * r.k->value, expected.k_mm3, kSame);
    expect_close(r.against_archard.statistic, expected.F, kSame);
    expect_close(r.against_archard.p, expected.F_p, kSame);
    EXPECT_TRUE(r.archard_rejected());
    EXPECT_EQ(r.one_out.folds, 20);
    EXPECT_EQ(r.level_out.folds, 5);
    expect_close(r.one_out.relative_error, expected.error, kSame);
    expect_close(r.one_out_archard.relative_error, expected.error_archard, kSame);
    EXPECT_EQ(r.residuals.outlier, 10U);
    expect_close(r.residuals.studentised[10], expected.studentised, kSame);
    expect_close(r.residuals.outlier_p, expected.outlier_p, kSame);
    expect_close(r.residuals.equal_scatter_p, expected.equal_scatter, kSame);
    expect_close(r.residuals.shapiro_wilk.p, expected.shapiro_p, kSingle);
    expect_close(r.curvature->statistic, expected.bend_F, 1e-8);
    expect_close(r.curvature->p, expected.bend_p, kSame);
    expect_close(r.lack_of_fit->statistic, expected.lack_F, kSame);
    expect_close(r.lack_of_fit->p, expected.lack_p, kSame);
    expect_close(r.archard.value, expected.alpha, kSame);
    expect_close(r.archard.low, expected.alpha_low, kSame);
    expect_close(r.archard.high, expected.alpha_high, kSame);
    // The power law predicts tests that it has not seen better, one by one and load by load.
    EXPECT_LT(r.one_out.relative_error, 0.7 * r.one_out_archard.relative_error);
    EXPECT_LT(r.level_out.relative_error, 0.7 * r.level_out_archard.relative_error);
  }
  const auto common = common_exponents(fits);
  ASSERT_TRUE(common);
  expect_close(common->statistic, 0.9389337307174308, 1e-8);
  expect_close(common->p, 0.39733451129109854, kSame);
}

TEST(WearLaw, OfTwoFactorsAgreesWithNumPy) {
  const WearTests tests{.volume = {1.2e-9, 3.1e-9, 2.9e-9, 7.7e-9, 5.6e-9, 16.4e-9, 5.1e-9},
                        .force = {5, 5, 10, 10, 20, 20, 10},
                        .distance = {100, 300, 100, 300, 100, 300, 200}};
  const WearLawFit r = fit_wear_law(tests, 0.9);
  ASSERT_EQ(r.identifiable, Identifiable::both);
  expect_close(r.p->value, 1.1564370288919121, kSame);
  expect_close(r.p->low, 1.0582086326438511, kSame);
  expect_close(r.p->high, 1.2546654251399731, kSame);
  expect_close(r.q->value, 0.9108345685893576, kSame);
  expect_close(r.q->low, 0.8101215404310423, kSame);
  expect_close(r.q->high, 1.0115475967476728, kSame);
  expect_close(1e9 * r.k->value, 0.0028326649191323062, kSame);
  expect_close(1e9 * r.k->low, 0.0016011750221265, kSame);
  expect_close(1e9 * r.k->high, 0.0050113138371505, kSame);
  expect_close(r.against_archard.statistic, 7.544672369071793, kSame);
  expect_close(r.against_archard.p, 0.04390742221179911, kSame);
}

TEST(WearLaw, RecoversExponentsWithoutNoiseToRoundOff) {
  const WearLawFit r = fit_wear_law(crossed(2e-14, 1.7, 0.8, 0.0, 1));
  ASSERT_EQ(r.identifiable, Identifiable::both);
  EXPECT_NEAR(r.p->value, 1.7, 1e-12);
  EXPECT_NEAR(r.q->value, 0.8, 1e-12);
  expect_close(r.k->value, 2e-14, 1e-11);
  EXPECT_LT(r.one_out.relative_error, 1e-11);
}

TEST(WearLaw, ItsIntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kTrials = 400;
  int p_held = 0, q_held = 0, k_held = 0, seen = 0;
  for (int i = 0; i < kTrials; ++i) {
    const WearLawFit r = fit_wear_law(crossed(2e-14, 1.6, 0.9, 0.3, static_cast<std::uint64_t>(i)));
    p_held += r.p->low <= 1.6 && 1.6 <= r.p->high ? 1 : 0;
    q_held += r.q->low <= 0.9 && 0.9 <= r.q->high ? 1 : 0;
    k_held += r.k->low <= 2e-14 && 2e-14 <= r.k->high ? 1 : 0;
    seen += r.archard_rejected() ? 1 : 0;
  }
  // 95 % of 400 is 380, with a standard deviation of 4.4: four of them.
  for (const int held : {p_held, q_held, k_held}) EXPECT_NEAR(held, 380, 18);
  EXPECT_GT(seen, 380);  // the load exponent is seven standard errors from 1
}

TEST(WearLaw, OfArchardIsRejectedAtTheStatedRate) {
  constexpr int kTrials = 600;
  int at_5 = 0, at_20 = 0;
  for (int i = 0; i < kTrials; ++i) {
    const WearTests tests = crossed(1e-13, 1.0, 1.0, 0.3, static_cast<std::uint64_t>(10000 + i));
    at_5 += fit_wear_law(tests, 0.95).archard_rejected() ? 1 : 0;
    at_20 += fit_wear_law(tests, 0.80).archard_rejected() ? 1 : 0;
  }
  EXPECT_NEAR(at_5, 30, 4 * 5.4);  // binomial standard deviations: sqrt(600 0.05 0.95), sqrt(600 0.2 0.8)
  EXPECT_NEAR(at_20, 120, 4 * 9.8);
}

TEST(WearLaw, SaysWhatADesignCannotTell) {
  const WearLawFit force = fit_wear_law(crossed(1e-13, 1.3, 1.0, 0.1, 3, {5, 10, 20, 50}, {1000}));
  EXPECT_EQ(force.identifiable, Identifiable::force);
  EXPECT_TRUE(force.p);
  EXPECT_FALSE(force.q);

  const WearLawFit distance = fit_wear_law(crossed(1e-13, 1.0, 0.7, 0.1, 3, {5}, {100, 300, 1000, 3000}));
  EXPECT_EQ(distance.identifiable, Identifiable::distance);
  EXPECT_FALSE(distance.p);
  EXPECT_TRUE(distance.q);

  const WearLawFit neither = fit_wear_law(crossed(1e-13, 1.0, 1.0, 0.1, 3, {5, 5, 5, 5}, {100}));
  EXPECT_EQ(neither.identifiable, Identifiable::neither);
  EXPECT_FALSE(neither.p || neither.q || neither.k || neither.combined);
  EXPECT_TRUE(std::isnan(neither.against_archard.p));
  EXPECT_FALSE(neither.archard_rejected());

  // Distance set to 40 F^(1/2) in every test: only p + q/2 is left, and it is found.
  WearTests tests;
  for (const double f : {4.0, 9.0, 16.0, 25.0, 36.0}) {
    tests.force.push_back(f);
    tests.distance.push_back(40.0 * std::sqrt(f));
    tests.volume.push_back(1e-13 * std::pow(f, 1.4) * std::pow(tests.distance.back(), 0.8));
  }
  const WearLawFit combined = fit_wear_law(tests);
  EXPECT_EQ(combined.identifiable, Identifiable::combined);
  EXPECT_FALSE(combined.p || combined.q || combined.k);
  ASSERT_TRUE(combined.combined);
  EXPECT_NEAR(combined.slope, 0.5, 1e-12);
  EXPECT_NEAR(combined.combined->value, 1.4 + 0.5 * 0.8, 1e-12);
}

TEST(WearLaw, LeftOutLevelsThatCarryAnExponentAreNotPredicted) {
  // Two loads: without one of them the exponent is gone.
  const WearLawFit r = fit_wear_law(crossed(1e-13, 1.2, 1.0, 0.1, 5, {5, 10, 5, 10}, {1000}));
  EXPECT_EQ(r.level_out.folds, 2);
  EXPECT_TRUE(std::isnan(r.level_out.relative_error));
  EXPECT_TRUE(std::isfinite(r.level_out_archard.relative_error));
  EXPECT_TRUE(std::isfinite(r.one_out.relative_error));
}

TEST(WearLaw, SeesABend) {
  WearTests tests = crossed(1e-13, 1.0, 1.0, 0.05, 7, {5, 10, 20, 50}, {100, 300, 1000});
  for (std::size_t i = 0; i < tests.volume.size(); ++i) {
    const double x = std::log(tests.force[i] / 15.0);
    tests.volume[i] *= std::exp(0.4 * x * x);
  }
  const WearLawFit r = fit_wear_law(tests);
  ASSERT_TRUE(r.curvature);
  EXPECT_LT(r.curvature->p, 1e-3);
}

TEST(WearLaw, RefusesWhatHasNoLogarithm) {
  EXPECT_THROW((void)fit_wear_law({.volume = {1, 2}, .force = {1, 2}, .distance = {1, 1}}), InputError);
  EXPECT_THROW((void)fit_wear_law({.volume = {1, 2, 0}, .force = {1, 2, 3}, .distance = {1, 1, 1}}),
               InputError);
  EXPECT_THROW((void)fit_wear_law({.volume = {1, 2, 3}, .force = {1, 2}, .distance = {1, 1, 1}}), InputError);
  EXPECT_THROW((void)fit_wear_law({.volume = {1, 2, 3}, .force = {1, 2, 3}, .distance = {1, 1, 1}}, 1.0),
               InputError);
}

}  // namespace
}  // namespace abradem::study
