// SPDX-License-Identifier: BSD-3-Clause
// Spheres in numbers against the slow and clear way: all pairs, one after another, by the laws of
// hertz_mindlin.h.
#include "abradem/contact/sphere_forces.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <map>
#include <numbers>
#include <set>

#include "abradem/contact/hertz_mindlin.h"
#include "abradem/core/random.h"

namespace abradem::contact {
namespace {

constexpr double kDt = 1e-5;
constexpr double kSkin = 3e-4;

/// Two materials, all three pairs different.
std::vector<PairProperties> two_materials(double rolling) {
  const material::Material a{2500.0, 1e8, 0.25}, b{7800.0, 3e8, 0.3};
  std::vector<PairProperties> p{material::effective_moduli(a, a), material::effective_moduli(a, b),
                                material::effective_moduli(b, a), material::effective_moduli(b, b)};
  const double e[]{0.3, 0.6, 0.6, 0.9}, mu[]{0.2, 0.5, 0.5, 0.0};
  for (std::size_t k = 0; k < 4; ++k)
    p[k].beta = material::damping_ratio(e[k]), p[k].static_friction = mu[k], p[k].rolling_friction = rolling;
  return p;
}

PairTable table_of(const std::vector<PairProperties>& properties) {
  PairTable table;
  table.materials = 2;
  for (const PairProperties& p : properties) {
    table.pair.push_back(PairConstants::of(p));
    table.rolling = table.rolling || p.rolling_friction > 0.0;
  }
  return table;
}

/// A crowd that overlaps by some per cent here and there and moves slowly.
Spheres crowd(std::size_t count, std::uint64_t seed) {
  core::RandomStream random(seed);
  Spheres spheres;
  const auto across = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  for (std::size_t i = 0; i < count; ++i) {
    SphereRow s;
    const auto place = [&](std::size_t k) {
      return 5.62e-3 * static_cast<double>(k) + random.uniform(-4e-5, 4e-5);
    };
    s.set_position({place(i % across), place(i / across % across), place(i / across / across)});
    const auto any = [&](double most) { return random.uniform(-most, most); };
    s.set_velocity({any(0.1), any(0.1), any(0.1)});
    s.set_spin({any(20.0), any(20.0), any(20.0)});
    s.radius = random.uniform(2.7e-3, 2.9e-3);
    s.material = static_cast<double>(i % 2);
    const double density = i % 2 == 0 ? 2500.0 : 7800.0;
    s.inverse_mass = 1.0 / (density * 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius);
    spheres.row.push_back(s);
    spheres.id.push_back(static_cast<std::int32_t>(i));
  }
  return spheres;
}

/// Forces and torques by sphere id, and the springs by pair of ids (of the lower id).
struct AllPairs {
  std::map<std::pair<int, int>, TangentialHistory> springs;
  std::vector<Vec3> force, torque;

  void step(const Spheres& spheres, const std::vector<PairProperties>& properties) {
    std::vector<const SphereRow*> by_id(spheres.size());
    for (std::size_t i = 0; i < spheres.size(); ++i)
      by_id[static_cast<std::size_t>(spheres.id[i])] = &spheres.row[i];
    force.assign(spheres.size(), {});
    torque.assign(spheres.size(), {});
    for (std::size_t a = 0; a < by_id.size(); ++a)
      for (std::size_t b = a + 1; b < by_id.size(); ++b) {
        const SphereRow &i = *by_id[a], &j = *by_id[b];
        const std::pair key(static_cast<int>(a), static_cast<int>(b));
        const Vec3 offset = i.position() - j.position();
        const double reach = i.radius + j.radius, overlap = reach - norm(offset);
        if (!(overlap > 0.0)) {
          springs.erase(key);
          continue;
        }
        const Vec3 n = normalized(offset);
        const auto& p = properties[static_cast<std::size_t>(2.0 * i.material + j.material)];
        const double R_eff = i.radius * j.radius / reach, m_eff = 1.0 / (i.inverse_mass + j.inverse_mass);
        const Vec3 v = i.velocity() - j.velocity() - cross(i.radius * i.spin() + j.radius * j.spin(), n);
        const ContactForce f =
            hertz_mindlin(p, {n, hertz_force(p, R_eff, overlap), contact_radius(R_eff, overlap), m_eff, v},
                          kDt, springs[key]);
        const auto inertia = [](const SphereRow& s) { return 0.4 * s.radius * s.radius / s.inverse_mass; };
        const double I = inertia(i) * inertia(j) / (inertia(i) + inertia(j));
        const Vec3 rolling = rolling_torque(p, R_eff, f.F_n, i.spin() - j.spin(), I, kDt);
        const Vec3 on_i = f.F_n * n + f.F_t;
        force[a] += on_i;
        force[b] -= on_i;
        torque[a] += cross(-i.radius * n, f.F_t) + rolling;
        torque[b] += cross(j.radius * n, -f.F_t) - rolling;
      }
  }
};

class SphereForces : public testing::TestWithParam<double> {};

TEST_P(SphereForces, AreThoseOfTheLawPairByPairWhileTheOrderChanges) {
  const std::vector<PairProperties> properties = two_materials(GetParam());
  const PairTable table = table_of(properties);
  Spheres spheres = crowd(1500, 7);  // two blocks, so that there are far pairs
  SphereList list;
  AllPairs reference;
  LoadRows load;
  double worst = 0.0;
  for (int step = 0; step < 40; ++step) {
    if (step % 8 == 0) list.rebuild(spheres, kSkin);
    ASSERT_TRUE(sphere_forces(spheres, list, table, kDt, load));
    if (step < 12 || step % 8 == 0) {
      reference.step(spheres, properties);
      double largest = 0.0;
      for (const Vec3& F : reference.force) largest = std::max(largest, norm(F));
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        const auto id = static_cast<std::size_t>(spheres.id[i]);
        worst = std::max({worst, norm(load[i].force() - reference.force[id]) / largest,
                          norm(load[i].torque() - reference.torque[id]) / (largest * 3e-3)});
      }
    } else {
      reference.step(spheres, properties);
    }
    advance_spheres(spheres.row, load, {0.0, 0.0, -9.81}, kDt);
  }
  EXPECT_GT(reference.springs.size(), 1000u);
  EXPECT_GT(list.guest.size(), 50u);
  EXPECT_LT(worst, 1e-12);  // round-off of another order of operations, over 40 steps
  RecordProperty("largest_error", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(Rolling, SphereForces, testing::Values(0.0, 0.05));

TEST(SphereForces, WithOptionsThatAreOffAreThoseWithout) {
  for (const double rolling : {0.0, 0.05}) {
    PairTable plain = table_of(two_materials(rolling)), full = plain;
    full.options = full.adhesion = true;
    Spheres a = crowd(1500, 7), b = a;
    SphereList of_a, of_b;
    of_b.remember_torques();
    LoadRows on_a, on_b;
    for (int step = 0; step < 30; ++step) {
      if (step % 8 == 0) of_a.rebuild(a, kSkin), of_b.rebuild(b, kSkin);
      ASSERT_TRUE(sphere_forces(a, of_a, plain, kDt, on_a));
      ASSERT_TRUE(sphere_forces(b, of_b, full, kDt, on_b));
      double largest = 0.0;
      for (const LoadRow& l : on_a) largest = std::max(largest, norm(l.force()));
      for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_LT(norm(on_a[i].force() - on_b[i].force()), 1e-12 * largest);
        ASSERT_LT(norm(on_a[i].torque() - on_b[i].torque()), 1e-12 * largest * 3e-3);
      }
      advance_spheres(a.row, on_a, {}, kDt);
      advance_spheres(b.row, on_b, {}, kDt);
    }
  }
}

TEST(SphereForces, WithOptionsActOnBothAndDoNotDependOnThreadsOrOrder) {
  std::vector<PairProperties> properties = two_materials(0.05);
  for (PairProperties& p : properties) p.options.rolling_spring = p.options.torsion = true;
  properties[0].options.adhesion = 0.2;
  properties[1].options.cohesion = properties[2].options.cohesion = 1e4;
  PairTable table = table_of(properties);
  table.options = table.adhesion = true;
  LoadRows first;
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Spheres spheres = crowd(4000, 3);
    SphereList list;
    list.remember_torques();
    LoadRows load;
    for (int step = 0; step < 20; ++step) {
      if (step % 7 == 0) list.rebuild(spheres, kSkin);
      ASSERT_TRUE(sphere_forces(spheres, list, table, kDt, load));
      advance_spheres(spheres.row, load, {}, kDt);
    }
    Vec3 sum;
    double largest = 0.0;
    load.resize(spheres.size());  // without the rows of guests
    for (const LoadRow& l : load) sum += l.force(), largest = std::max(largest, norm(l.force()));
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(norm(sum), 1e-10 * largest);
    if (first.empty()) first = load;
    for (std::size_t i = 0; i < load.size(); ++i) {
      ASSERT_EQ(load[i].force(), first[i].force()) << threads << " threads, sphere " << i;
      ASSERT_EQ(load[i].torque(), first[i].torque()) << threads << " threads, sphere " << i;
    }
  }
  omp_set_num_threads(before);
}

/// Whether forces are found first or on the way, with how many threads, and whichever pairs that do not touch
/// are looked at besides.
TEST(SphereForces, AndMotionInOnePassAreThoseInTwo) {
  const PairTable table = table_of(two_materials(0.02));
  const Vec3 gravity{0.0, 0.0, -9.81};
  Spheres expected = crowd(4000, 3);
  SphereList whole;
  LoadRows load;
  for (int step = 0; step < 20; ++step) {
    if (step % 7 == 0) whole.rebuild(expected, kSkin);
    ASSERT_TRUE(sphere_forces(expected, whole, table, kDt, load));
    advance_spheres(expected.row, load, gravity, kDt);
  }
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Spheres spheres = crowd(4000, 3);
    SphereList list;
    std::size_t fewest = whole.pairs();
    for (int step = 0; step < 20; ++step) {
      constexpr double kMargin = 1e-5;  // spheres move by less than half of it in a step
      if (step % 7 == 0)
        list.rebuild(spheres, kSkin, kMargin);
      else
        list.find_near(spheres, kMargin);
      std::size_t near = 0;
      list.for_each_near([&](const ContactBlock&, std::size_t) { ++near; });
      fewest = std::min(fewest, near);
      EXPECT_TRUE(forces_and_advance(spheres, list, table, kDt, load, gravity, [](auto, auto) {}).sound);
    }
    EXPECT_GT(fewest, 1000u);
    EXPECT_LT(fewest, whole.pairs() / 2);
    ASSERT_EQ(spheres.id, expected.id);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      ASSERT_EQ(spheres.row[i].position(), expected.row[i].position()) << threads << " threads, sphere " << i;
      ASSERT_EQ(spheres.row[i].velocity(), expected.row[i].velocity()) << threads << " threads, sphere " << i;
      ASSERT_EQ(spheres.row[i].spin(), expected.row[i].spin()) << threads << " threads, sphere " << i;
    }
  }
  omp_set_num_threads(before);
}

TEST(SphereForces, AreTheSameBitsForAnyNumberOfThreads) {
  const PairTable table = table_of(two_materials(0.02));
  LoadRows first;
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Spheres spheres = crowd(4000, 3);
    SphereList list;
    list.rebuild(spheres, kSkin);
    LoadRows load;
    for (int step = 0; step < 5; ++step) {
      ASSERT_TRUE(sphere_forces(spheres, list, table, kDt, load));
      advance_spheres(spheres.row, load, {}, kDt);
    }
    if (first.empty()) first = load;
    for (std::size_t i = 0; i < load.size(); ++i) {
      ASSERT_EQ(load[i].force(), first[i].force()) << threads << " threads, sphere " << i;
      ASSERT_EQ(load[i].torque(), first[i].torque()) << threads << " threads, sphere " << i;
    }
  }
  omp_set_num_threads(before);
}

TEST(SphereForces, ReportAnOverlapBeyondTheLaw) {
  const PairTable table = table_of(two_materials(0.0));
  Spheres spheres = crowd(2, 1);
  spheres.row[0].set_position({0, 0, 0});
  spheres.row[1].set_position({0.89 * (spheres.row[0].radius + spheres.row[1].radius), 0, 0});
  SphereList list;
  list.rebuild(spheres, kSkin);
  LoadRows load;
  EXPECT_FALSE(sphere_forces(spheres, list, table, kDt, load));
}

TEST(SphereList, HoldsThePairsWithinTheSkinAndNoOthers) {
  Spheres spheres = crowd(700, 11);
  spheres.row[5].set_position({3.0, -2.0, 1.0});  // one has strayed far: the grid may not grow without bound
  SphereList list;
  list.rebuild(spheres, kSkin);
  std::set<std::pair<int, int>> listed;
  list.for_each_near([&](const ContactBlock& block, std::size_t k) {
    EXPECT_LT(block.i[k], block.j[k]);
    const int a = spheres.id[static_cast<std::size_t>(block.i[k])],
              b = spheres.id[static_cast<std::size_t>(block.j[k])];
    EXPECT_TRUE(listed.insert({std::min(a, b), std::max(a, b)}).second);
  });
  EXPECT_EQ(listed.size(), list.pairs());
  std::size_t near = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = i + 1; j < spheres.size(); ++j) {
      const SphereRow &a = spheres.row[i], &b = spheres.row[j];
      if (norm(a.position() - b.position()) >= a.radius + b.radius + kSkin) continue;
      ++near;
      EXPECT_TRUE(
          listed.contains({std::min(spheres.id[i], spheres.id[j]), std::max(spheres.id[i], spheres.id[j])}));
    }
  EXPECT_EQ(near, listed.size());
}

TEST(SphereList, TakesOutThoseThatAreGoneAndKeepsTheOthersSprings) {
  const PairTable table = table_of(two_materials(0.0));
  Spheres spheres = crowd(300, 5);
  SphereList list;
  list.rebuild(spheres, kSkin);
  LoadRows load;
  for (int step = 0; step < 3; ++step) {
    ASSERT_TRUE(sphere_forces(spheres, list, table, kDt, load));
    advance_spheres(spheres.row, load, {}, kDt);
  }
  const auto springs = [&] {
    std::map<std::pair<int, int>, Vec3> all;
    list.for_each_near([&](const ContactBlock& block, std::size_t k) {
      if (block.touching[k] == 0) return;
      const int a = spheres.id[static_cast<std::size_t>(block.i[k])],
                b = spheres.id[static_cast<std::size_t>(block.j[k])];
      all[{std::min(a, b), std::max(a, b)}] = a < b ? block.spring(k) : -block.spring(k);
    });
    return all;
  };
  auto before = springs();
  for (std::size_t i = 0; i < spheres.size(); ++i)
    if (spheres.id[i] % 10 == 0) spheres.id[i] = -1;
  std::erase_if(before,
                [](const auto& pair) { return pair.first.first % 10 == 0 || pair.first.second % 10 == 0; });
  list.rebuild(spheres, kSkin);
  EXPECT_EQ(spheres.size(), 270u);
  EXPECT_EQ(springs(), before);
  EXPECT_GT(before.size(), 100u);
}

}  // namespace
}  // namespace abradem::contact
