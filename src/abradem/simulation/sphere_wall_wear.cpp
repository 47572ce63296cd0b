// SPDX-License-Identifier: BSD-3-Clause
// What a contact between a sphere and a wall wears off: where it falls, off the sphere's tip, into ridges.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "abradem/simulation/sphere_wall.h"

namespace abradem::simulation {

namespace {
std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }
}  // namespace

/// Where the Hertz footprint lies wholly inside one triangle, its pressure is symmetric about the nearest
/// point, so that its moments with the (linear) shape functions are these functions there: no integral is
/// needed.
bool SphereWall::lands_inside(const contact::CandidateTriangle& triangle, const Vec3& point, double a,
                              WearShare& share) noexcept {
  const auto& [p0, p1, p2] = triangle.corner;
  const Vec3 area = cross(p1 - p0, p2 - p0);
  const double area2 = norm2(area);
  // Shares of the area opposite each corner; over an edge's length, distances from the edges.
  const double b0 = dot(area, cross(p2 - p1, point - p1)) / area2,
               b1 = dot(area, cross(p0 - p2, point - p2)) / area2, b2 = 1.0 - b0 - b1;
  const double size = std::sqrt(area2);
  if (b0 * size < a * norm(p2 - p1) || b1 * size < a * norm(p0 - p2) || b2 * size < a * norm(p1 - p0))
    return false;
  share = {triangle.triangle, triangle.vertex, 1.0, b0, b1, b2, triangle.area};
  return true;
}

/// Under a sphere as new whose contact is a point.
void SphereWall::land_on_triangles(const Wall& wall, const Touch& touch, double R, double d_e,
                                   std::vector<WearShare>& shares) {
  const bool hertz = wall.setup().footprint == Footprint::hertz;
  const std::span<const contact::CandidateTriangle> under = points_.triangles_of(touch.part);
  if (hertz && wall.setup().deformation != DeformationRule::paper) {
    const auto nearest = std::ranges::find(under, touch.nearest, &contact::CandidateTriangle::local);
    WearShare share;
    if (lands_inside(*nearest, touch.point, contact::contact_radius(R, d_e), share)) {
      shares.push_back(share);
      return;
    }
  }
  const wear::Ball ball{centre_, R, touch.deepest};
  const wear::FootprintShares& print =
      hertz ? scratch().footprint.hertz(under, ball, d_e) : scratch().footprint.overlap(under, ball);
  if (!(print.total > 0.0)) return;
  const double part = 1.0 / print.total;
  for (std::size_t k = 0; k < print.count; ++k)
    if (const double w = (print.at0[k] + print.at1[k]) + print.at2[k]; w > 0.0)
      shares.push_back({under[k].triangle, under[k].vertex, part * w, part * print.at0[k],
                        part * print.at1[k], part * print.at2[k], under[k].area});
}

/// Where what a contact does to the wall falls; on a plane nowhere.
SphereWall::Landing SphereWall::land(const Wall& wall, const Touch& touch, double R, double d_e) {
  if (wall.is_plane()) return {};
  std::vector<WearShare>& shares = scratch().shares;
  shares.clear();
  const bool paper = wall.setup().deformation == DeformationRule::paper;
  if (wall.setup().contact == ContactRule::per_triangle) {
    const std::size_t t = at(touch.part);
    const contact::CandidateTriangle triangle = candidates_.triangle_at(t);
    WearShare share{triangle.triangle, triangle.vertex, 1.0, 0.0, 0.0, 0.0, triangle.area};
    if (!paper) {
      const Vec3 a = triangle.corner[0], e1 = triangle.corner[1] - a, e2 = triangle.corner[2] - a;
      const Vec3 p = touch.point - a;
      const double d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), det = d11 * d22 - d12 * d12;
      share.at1 = std::clamp((d22 * dot(p, e1) - d12 * dot(p, e2)) / det, 0.0, 1.0);
      share.at2 = std::clamp((d11 * dot(p, e2) - d12 * dot(p, e1)) / det, 0.0, 1.0 - share.at1);
      share.at0 = 1.0 - share.at1 - share.at2;
    }
    shares.push_back(share);
    return {nullptr, shares};
  }

  if (touch.of_point && !tip_.worn()) {
    land_on_triangles(wall, touch, R, d_e, shares);
    return {nullptr, shares};
  }
  const std::span<const char> mask = mask_of(wall, touch.part, touch.of_point);
  const wear::OverlapField field = overlap_field(R, touch.deepest, touch.of_point);
  const wear::FootprintShares& print = wall.setup().footprint == Footprint::hertz
                                           ? scratch().footprint.hertz(candidates_, field, d_e, paper, mask)
                                           : scratch().footprint.overlap(candidates_, field, paper, mask);
  if (!(print.total > 0.0)) return {};
  if (print.nodal) return {&print, {}};
  const double part = 1.0 / print.total;
  for (std::size_t t = 0; t < print.count; ++t)
    if (const double w = (print.at0[t] + print.at1[t]) + print.at2[t]; w > 0.0)
      shares.push_back({candidates_.triangle[t], candidates_.triangle_at(t).vertex, part * w,
                        part * print.at0[t], part * print.at1[t], part * print.at2[t], candidates_.area[t]});
  return {nullptr, shares};
}

void SphereWall::deposit_landed(Wall& wall, const Landing& landing, double dV) {
  if (landing.nowhere()) return;
  wear::WearingSurface& surface = wall.surface();
  if (landing.nodes != nullptr) {
    const wear::FootprintShares& shares = *landing.nodes;
    const double scale = dV / shares.total;
    node_pending_.resize(candidates_.x.size());
    for (std::size_t i = 0; i < shares.at_node.size(); ++i) {
      if (!(shares.at_node[i] > 0.0)) continue;
      const double volume = scale * shares.at_node[i];
      node_pending_[i] += volume;
      surface.deposit_at_vertex(candidates_.node[i], volume);
    }
  } else if (wall.setup().deformation == DeformationRule::paper) {
    for (const WearShare& s : landing.triangles) surface.deposit_element(s.triangle, dV * s.whole);
  } else {
    for (const WearShare& s : landing.triangles)
      surface.deposit(s.triangle, s.vertex, dV * s.whole, dV * s.at0, dV * s.at1, dV * s.at2);
  }
}

double SphereWall::deposit(Wall& wall, double alpha_s, double R, const contact::PairProperties& pair,
                           const Sliding& sliding) {
  double volume = 0.0;
  for (const Touch& touch : touches_) {
    const double dV = wear::archard_volume(alpha_s, {std::max(touch.force.F_n, 0.0), sliding.of(touch)});
    if (dV > 0.0)
      deposit_landed(
          wall, land(wall, touch, R, contact::hertz_overlap(pair, R, touch.force.F_n / touch.weight)), dV);
    volume += dV;
  }
  return volume;
}

/// What the wall sees of a contact in this step; but for its place.
void SphereWall::fill_sample(const Touch& touch, const SphereState& sphere,
                             const contact::PairProperties& pair, const Sliding& sliding,
                             wear::MapSample& sample) const {
  sample.work = work_of(touch, sliding.of(touch), sphere.mass, pair, sliding.dt);
  sample.load = {norm(touch.force.F_t), touch.force.v_t, sliding.dt,
                 sphere.radius,         sphere.mass,     touch.weight};
  if (touch.memory < 0) return;
  if (const Memory& memory = memory_[at(touch.memory)]; memory.striking) {
    sample.strikes = true;
    sample.impact = {memory.speed, memory.angle, sphere.mass, 2.0 * sphere.radius};
  }
}

void SphereWall::record_wear(const Wall& wall, const SphereState& sphere, const contact::PairProperties& pair,
                             const Recording& how, WearRecords& records) {
  const double R = sphere.radius;
  for (const Touch& touch : touches_) {
    if (how.sliding_only && !(touch.force.F_n > 0.0 && how.sliding.of(touch) > 0.0)) continue;
    const double d_e = contact::hertz_overlap(pair, R, touch.force.F_n / touch.weight);
    const Landing landing = land(wall, touch, R, d_e);
    const bool nodal = landing.nodes != nullptr;
    WearRecords::Record& record = records.record.emplace_back();
    record.contact = how.contact;
    record.wall = how.wall;
    record.material = how.material;
    record.nodal = nodal;
    record.first = nodal ? records.node.size() : records.share.size();
    fill_sample(touch, sphere, pair, how.sliding, record.sample);
    record.sample.hertz_area = std::numbers::pi * R * d_e;
    if (nodal)
      records.node.insert(records.node.end(), landing.nodes->at_node.begin(), landing.nodes->at_node.end());
    else
      records.share.insert(records.share.end(), landing.triangles.begin(), landing.triangles.end());
    record.end = nodal ? records.node.size() : records.share.size();
  }
}

void SphereWall::book(Wall& wall, const WearRecords& records, const WearRecords::Record& record,
                      const wear::MapSample& sample, const MapLayer& map) {
  Landing landing;
  wear::FootprintShares nodes;
  if (record.nodal) {
    nodes.nodal = true;
    nodes.at_node = std::span(records.node).subspan(record.first, record.end - record.first);
    for (const double load : nodes.at_node) nodes.total += load;
    landing.nodes = &nodes;
  } else {
    landing.triangles = std::span(records.share).subspan(record.first, record.end - record.first);
  }
  if (const double dV = wear::total(sample.volumes); dV > 0.0) deposit_landed(wall, landing, dV);
  if (map.layer != nullptr) map_landed(map, landing, sample);
}

/// Triangles of one contact (0: not of it); empty: all.
std::span<const char> SphereWall::mask_of(const Wall& wall, int part, bool of_point) {
  const std::span<const int> parts = of_point ? points_.sets(candidates_) : patches_.clusters();
  if (parts.empty() || wall.setup().contact == ContactRule::per_triangle) return {};
  std::vector<char>& mask = scratch().mask;
  mask.resize(candidates_.triangle_count());
  for (std::size_t t = 0; t < mask.size(); ++t) mask[t] = parts[t] == part;
  return mask;
}

wear::OverlapField SphereWall::overlap_field(double R, double deepest, bool of_point) {
  return {of_point ? points_.node_excess(candidates_) : patches_.node_excess(),
          R,
          deepest,
          tip_,
          of_point ? points_.raw_excess() : patches_.raw_excess(),
          centre_};
}

const std::vector<SphereWall::Spot>& SphereWall::find_spots(const Wall& wall) {
  spots_.clear();
  const bool as_one = wall.setup().contact == ContactRule::per_triangle && !wall.is_plane();
  for (const Touch& touch : touches_) {
    const double force = std::max(touch.force.F_n, 0.0);
    if (!(force > 0.0)) continue;
    // Two rules that share a contact press the same spot.
    auto alike = as_one ? spots_.begin() : spots_.end();
    if (touch.weight < 1.0)
      alike =
          std::ranges::find_if(spots_, [&](const Spot& s) { return dot(normalized(s.n), touch.n) > 0.9; });
    if (alike == spots_.end())
      alike = spots_.insert(spots_.end(), {{}, 0.0, 0.0, touch.part, touch.of_point});
    Spot& spot = *alike;
    spot.n += force * touch.n;
    spot.force += force;
    spot.deepest = std::max(spot.deepest, touch.deepest);
  }
  for (Spot& spot : spots_) spot.n = normalized(spot.n);
  return spots_;
}

double SphereWall::wear_tip(wear::WearingTip& tip, const Wall& wall, double alpha_s,
                            const contact::PairProperties& pair, bool due, const Sliding& sliding) {
  double volume = 0.0;
  for (const Touch& touch : touches_)
    volume += wear::archard_volume(alpha_s, {std::max(touch.force.F_n, 0.0), sliding.of(touch)});
  tip_pending_ += volume;
  if (due || tip_pending_ > tip_batch_) shape_tip(tip, wall, pair, due);
  return volume;
}

/// Takes the pending wear off the tip, in pieces so small that the pressure hardly changes in one. It is
/// shared out by the pressure of this moment for all that came since the last time. Where the tip just rides
/// on a bump, all but one piece waits for a place with more of it under load, unless an output is due.
void SphereWall::shape_tip(wear::WearingTip& tip, const Wall& wall, const contact::PairProperties& pair,
                           bool due) {
  constexpr double kBatch = 0.02, kPiece = 0.05;  // of the Hertz approach, in mean recession
  constexpr int kMostPieces = 30;
  const double R = tip.radius();
  const std::vector<Spot>& all = find_spots(wall);
  double force = 0.0, area = 0.0, batch = 0.0, left = 0.0;
  for (const Spot& spot : all) force += spot.force;
  if (!(force > 0.0)) return;
  for (const Spot& spot : all) {
    const double d_e = contact::hertz_overlap(pair, R, spot.force);
    double volume = tip_pending_ * (spot.force / force);
    for (int piece = 0; piece < kMostPieces && volume > 0.0; ++piece) {
      press(tip, wall, spot, wall.setup().footprint == Footprint::overlap ? 0.0 : d_e);
      const double part = std::min(volume, kPiece * d_e * tip.pressed_area());
      tip.wear(part);
      volume -= part;
      if (!due && tip.pressed_area() < 0.5 * tip_area_) break;
    }
    left += volume;
    area += tip.pressed_area();
    batch += kBatch * d_e * tip.pressed_area();
  }
  tip_pending_ = left;
  tip_area_ = std::max(area, 0.9 * tip_area_);
  tip_batch_ = batch;
}

void SphereWall::press(wear::WearingTip& tip, const Wall& wall, const Spot& spot, double d_e) {
  const double R = tip.radius();
  if (wall.is_plane()) {
    const MeshSetup& plane = wall.setup().mesh;
    tip.press_on_plane({{{}, R, spot.deepest, tip_, {}, centre_}, tip_, d_e},
                       dot(centre_ - plane.position, plane.normal), plane.normal, -R * spot.n);
  } else {
    tip.press_on(
        candidates_,
        {overlap_field(R, spot.deepest, spot.of_point), tip_, d_e, mask_of(wall, spot.part, spot.of_point)},
        -R * spot.n);
  }
}

void SphereWall::plough(Wall& wall, const wear::Ploughing& ploughing, const Displaced& displaced, double R,
                        const contact::PairProperties& pair) {
  unpiled_ += displaced.volume;
  slid_ += displaced.way;
  const std::vector<Spot>& now = find_spots(wall);
  if (!now.empty()) {
    ploughing_.clear();
    for (const Spot& spot : now) {
      const Vec3 forward = normalized(displaced.v - dot(displaced.v, spot.n) * spot.n);
      ploughing_.push_back({{centre_, R, tip_, spot.n, forward, displaced.turning, spot.deepest,
                             contact::hertz_overlap(pair, R, spot.force)},
                            spot.force});
    }
  }
  if (unpiled_ == 0.0 || ploughing_.empty()) return;
  double length = ridges_.half_length(), force = 0.0;
  for (const auto& [contact, F_n] : ploughing_) {
    length = std::max(length, contact::contact_radius(R, contact.d_e));
    force += F_n;
  }
  if (!displaced.due && !now.empty() && slid_ < displaced.spacing * length) return;
  double left = 0.0;
  for (auto& [contact, F_n] : ploughing_) {
    const double share = unpiled_ * (F_n / force);
    contact.cut = slid_ > 0.0 ? share / ((1.0 - ploughing.removed_fraction) * slid_) : 0.0;
    left += contact.forward == Vec3{}
                ? share
                : ridges_.pile_up(wall.surface(), wall.view(), contact, ploughing, share);
  }
  unpiled_ = left;
  slid_ = 0.0;
}

/// What fell to a node was lost by the triangles around it, each by its part of the node's area.
void SphereWall::book_elements(Wall& wall) {
  if (node_pending_.empty()) return;
  for (std::size_t i = 0; i < candidates_.node_count(); ++i) node_pending_[i] /= candidates_.node_area[i];
  for (std::size_t t = 0; t < candidates_.triangle_count(); ++t) {
    const double depths = node_pending_[at(candidates_.v0[t])] + node_pending_[at(candidates_.v1[t])] +
                          node_pending_[at(candidates_.v2[t])];
    if (depths > 0.0)
      wall.surface().book_element(candidates_.triangle[t], depths * candidates_.area[t] / 3.0);
  }
  node_pending_.clear();
}

}  // namespace abradem::simulation
