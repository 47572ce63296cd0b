// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/wear/ridges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abradem::wear {

namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

contact::CandidateSkin thin(double R) { return {.tangential = 1e-6 * R, .normal = 1e-6 * R, .slide = {}}; }

}  // namespace

/// Gathers the surface around the contact, out to a distance `margin` below the sphere.
bool RidgeBuilder::gather(const contact::SurfaceView& view, const PloughingContact& contact, double margin) {
  candidates_.reset();
  candidates_.update(view, contact.c, -contact.n, contact.R + margin, thin(contact.R));
  return candidates_.node_count() > 0;
}

/// Which nodes lie beside the contact, and how much each can take of a volume `side` on either side.
void RidgeBuilder::sort_places(const WearingSurface& surface, const PloughingContact& contact, double side) {
  const Vec3 across = cross(contact.n, contact.forward);
  const double bend = dot(contact.turning, across);
  const double pressed = contact.deepest - 0.5 * contact.d_e;  // overlap from which on the sphere presses
  const double edge = std::sqrt(candidates_.longest_edge2);
  const double window = std::max({half_length_, std::sqrt(contact.R * contact.d_e), edge});
  // A pile lies along the whole window: no node takes more than twice what one row of nodes would, or the
  // lowest of an irregular mesh would become a spike.
  const double highest = side / (window * edge);
  const auto overlap_at = [&](const Vec3& offset) { return contact.tip.overlap(offset, contact.R); };
  struct Near {
    std::size_t node;
    double x, y, room, room_here;
  };
  std::vector<Near> near;
  double low = 0.0, high = 0.0, front = 0.0, length = 0.0;  // of what is pressed
  for (std::size_t i = 0; i < candidates_.node_count(); ++i) {
    const Vec3 offset = candidates_.node_position(i) - contact.c;
    const double x = dot(offset, contact.forward);
    const Vec3 beside = offset - x * contact.forward - (0.5 * x * x * bend) * across;  // of the path
    const double y = dot(beside, across);
    const double here = overlap_at(offset);
    if (here > pressed) length = std::max(length, std::abs(x)), front = std::max(front, x);
    if (x < -window || x > 2.0 * window) continue;
    // The sphere slides over the whole window: what counts is its middle section.
    const double section = overlap_at(beside);
    if (section > pressed && std::abs(x) <= window) low = std::min(low, y), high = std::max(high, y);
    near.push_back({i, x, y, pressed - section, pressed - here});
  }
  half_length_ = length;
  // A ridge grows while the sphere sinks; its flank is that of the sphere halfway. docs/theory/ploughing.md
  const double halfway = high > low ? std::min(0.5 * contact.cut / (high - low), contact.d_e) : 0.0;
  left_.clear(), right_.clear(), ahead_.clear();
  for (const Near& p : near) {
    const double height = surface.height(candidates_.node[p.node]), area = candidates_.node_area[p.node];
    if (const double room = std::min(p.room + halfway, highest); room > 0.0 && std::abs(p.x) <= window) {
      if (p.y > high) left_.push_back({p.node, p.y, height, room, area});
      if (p.y < low) right_.push_back({p.node, -p.y, height, room, area});
    }
    if (p.room_here > 0.0 && p.x > front && p.y >= low && p.y <= high)
      ahead_.push_back({p.node, p.x, height, p.room_here, area});
  }
}

double RidgeBuilder::capacity(const std::vector<Place>& places) noexcept {
  double sum = 0.0;
  for (const Place& p : places) sum += p.area * p.room;
  return sum;
}

namespace {

template <typename Places>
double filled(const Places& places, double slope, double level) noexcept {
  double sum = 0.0;
  for (const auto& p : places) sum += p.area * std::clamp(level - slope * p.outwards - p.height, 0.0, p.room);
  return sum;
}

/// The level to which a volume fills the places: a rising, piecewise linear function, by bisection between
/// its bounds and then exactly on the last piece.
template <typename Places>
double level_of(const Places& places, double slope, double volume) noexcept {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& p : places) {
    const double ground = slope * p.outwards + p.height;
    low = std::min(low, ground), high = std::max(high, ground + p.room);
  }
  double below = 0.0, above = filled(places, slope, high);
  for (int i = 0; i < 60 && above > below; ++i) {
    // Regula falsi and halving in turn: few pieces lie between.
    const double f = i % 2 == 0 ? (volume - below) / (above - below) : 0.5;
    const double level = low + std::clamp(f, 0.0, 1.0) * (high - low);
    if (level <= low || level >= high) break;
    const double v = filled(places, slope, level);
    if (std::abs(v - volume) <= 1e-12 * volume) return level;
    if (v < volume)
      low = level, below = v;
    else
      high = level, above = v;
  }
  return above > below ? low + (volume - below) / (above - below) * (high - low) : high;
}

}  // namespace

/// Raises the places by a volume; exact, since the shares are scaled to it.
double RidgeBuilder::fill(WearingSurface& surface, const std::vector<Place>& places, double slope,
                          double volume) {
  if (places.empty() || !(volume > 0.0)) return volume;
  const double level = level_of(places, slope, volume);
  const double sum = filled(places, slope, level);
  if (!(sum > 0.0)) return volume;
  for (const Place& p : places) {
    const double part = p.area * std::clamp(level - slope * p.outwards - p.height, 0.0, p.room);
    if (!(part > 0.0)) continue;
    const double share = volume * (part / sum);
    surface.raise_vertex(candidates_.node[p.node], share);
    piled_[p.node] += share;
  }
  return 0.0;
}

double RidgeBuilder::pile_up(WearingSurface& surface, const contact::SurfaceView& view,
                             const PloughingContact& contact, const Ploughing& ploughing, double volume) {
  constexpr double kWidest = 0.05;  // of R: the surface seen below the sphere
  constexpr double kGrowth = 1.6;
  if (margin_ == 0.0) margin_ = std::max(contact.d_e, 1e-5 * contact.R);
  const double ahead = ploughing.ahead * volume, side = 0.5 * (volume - ahead);
  double reached = -1.0;
  while (true) {
    if (!gather(view, contact, margin_)) return volume;
    sort_places(surface, contact, side);
    // Wide enough: the sides hold the volume, and the fill ends before the surface seen does.
    const double edge = std::sqrt(candidates_.longest_edge2);
    double furthest = 0.0;
    bool enough = true;
    for (const auto* places : {&left_, &right_}) {
      double outermost = 0.0;
      for (const Place& p : *places) outermost = std::max(outermost, p.outwards);
      furthest += outermost;
      enough = enough && capacity(*places) > 1.2 * side &&
               level_of(*places, ploughing.slope, side) < ploughing.slope * (outermost - edge);
    }
    if (enough || margin_ >= kWidest * contact.R) break;
    if (furthest > 0.0 && furthest - reached < 1e-9 * contact.R) {  // the surface ends there
      margin_ /= kGrowth;
      break;
    }
    reached = furthest;
    margin_ = std::min(kGrowth * margin_, kWidest * contact.R);
  }
  piled_.assign(candidates_.node_count(), 0.0);
  const bool in_front = capacity(ahead_) > 0.0, on_left = capacity(left_) > 0.0,
             on_right = capacity(right_) > 0.0;
  const double beside = in_front ? 2.0 * side : volume;
  double left_over = in_front ? fill(surface, ahead_, ploughing.slope, ahead) : 0.0;
  if (on_left) left_over += fill(surface, left_, ploughing.slope, on_right ? 0.5 * beside : beside);
  if (on_right) left_over += fill(surface, right_, ploughing.slope, on_left ? 0.5 * beside : beside);
  if (!on_left && !on_right) left_over += beside;
  book_elements(surface);
  return left_over;
}

/// What a node gained was gained by the triangles around it, each by its part of the node's area.
void RidgeBuilder::book_elements(WearingSurface& surface) {
  for (std::size_t t = 0; t < candidates_.triangle_count(); ++t) {
    double volume = 0.0;
    for (const std::int32_t v : {candidates_.v0[t], candidates_.v1[t], candidates_.v2[t]})
      volume += piled_[at(v)] / candidates_.node_area[at(v)];
    if (volume > 0.0) surface.book_element(candidates_.triangle[t], -volume * candidates_.area[t] / 3.0);
  }
}

}  // namespace abradem::wear
