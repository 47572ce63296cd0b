// SPDX-License-Identifier: BSD-3-Clause
// What a step wears, and the account of it. docs/architecture.md#accumulate_wear
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/error.h"
#include "abradem/simulation/simulation.h"

namespace abradem::simulation {

bool Simulation::wears_by_speed(const Wall& wall) const noexcept {
  return wall.wears_by_speed() || setup_.run.method == Method::quasi_static;
}

void Simulation::accumulate_wear() {
  try {
    book_wear();
  } catch (const SimulationError& error) {
    throw SimulationError(fmt::format("step {}, {:.6g} s: {}", steps_, time(), error.what()));
  }
}

void Simulation::book_wear() {
  if (settling()) return;
  for (std::size_t p = 0; p < particles_.size(); ++p)
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      Wall& wall = walls_[w];
      SphereWall& contact = sphere_walls_[p * walls_.size() + w];
      const double alpha_s = groove_coefficient(particles_.material[p], wall.material());
      if (by_laws_[w] != 0 || map_layer(w, particles_.material[p]).layer != nullptr) {
        records_.clear();
        contact.record_wear(wall, {{}, {}, {}, particles_.radius[p], particles_.mass[p]},
                            pair(particles_.material[p], wall.material()),
                            {.sliding = {dt_, wears_by_speed(wall)},
                             .wall = static_cast<std::int32_t>(w),
                             .material = particles_.material[p]},
                            records_);
        for (const WearRecords::Record& record : records_.record)
          law_[w] += book_contact(contact, records_, record);
      } else if (alpha_s != 0.0) {
        const double volume =
            contact.deposit(wall, alpha_s, particles_.radius[p],
                            pair(particles_.material[p], wall.material()), {dt_, wears_by_speed(wall)});
        if (ploughs())
          plough(
              contact, w,
              {particles_.position[p], particles_.velocity[p], particles_.radius[p], particles_.material[p]},
              volume);
        else
          law_[w] += volume;
      }
      if (tips_[p]) wear_tip(p, w);
    }
  if (bulk_) book_bulk_wear();
}

/// Asks the memory for what these will be booked on, which lies here and there.
void Simulation::fetch_elements(const WearRecords& records) {
  for (const WearRecords::Record& r : records.record) {
    if (r.nodal) continue;
    const auto w = static_cast<std::size_t>(r.wall);
    const MapLayer map = map_layer(w, r.material);
    if (map.layer != nullptr) map.layer->fetch(r.sample);
    for (std::size_t k = r.first; k < r.end; ++k) {
      const geometry::Index t = records.share[k].triangle;
      walls_[w].surface().fetch(t, records.share[k].vertex);
      if (map.layer != nullptr) map.layer->fetch(static_cast<std::size_t>(t));
    }
  }
}

void Simulation::book_bulk_wear() {
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].is_plane()) law_[w] += by_laws_[w] != 0 ? plane_wear_by_laws(w) : plane_wear(w);
  std::vector<BulkWalls::NearMesh>& meshes = bulk_->walls().meshes();
  std::vector<double> groove(ploughs() ? meshes.size() : 0, 0.0);  // of each contact [m^3]
  const std::vector<WearRecords>& parts = bulk_->walls().wear();
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (part + 1 < parts.size()) fetch_elements(parts[part + 1]);
    const WearRecords& records = parts[part];
    for (const WearRecords::Record& record : records.record) {
      BulkWalls::NearMesh& m = meshes[static_cast<std::size_t>(record.contact)];
      const double volume = book_contact(*m.contact, records, record);
      m.owes = m.owes || record.nodal;
      if (ploughs())
        groove[static_cast<std::size_t>(record.contact)] += volume;
      else
        law_[static_cast<std::size_t>(record.wall)] += volume;
    }
  }
  for (std::size_t k = 0; k < groove.size(); ++k) {
    const contact::SphereRow& s = bulk_->spheres().row[static_cast<std::size_t>(meshes[k].sphere)];
    if (groove[k] > 0.0 || meshes[k].contact->unpiled_volume() > 0.0)
      plough(*meshes[k].contact, static_cast<std::size_t>(meshes[k].wall),
             {s.position(), s.velocity(), s.radius, static_cast<int>(s.material)}, groove[k]);
  }
}

/// Books one contact by the laws of its pair. @return the law's volume; where they plough, that of the groove
/// [m^3]
double Simulation::book_contact(SphereWall& contact, const WearRecords& records,
                                const WearRecords::Record& record) {
  const auto w = static_cast<std::size_t>(record.wall);
  const int material = record.material;
  wear::MapSample sample = record.sample;
  const MapLayer map = map_layer(w, material);
  if (by_laws_[w] == 0 && map.layer == nullptr) {
    sample.volumes[static_cast<std::size_t>(wear::Mechanism::archard)] =
        wear::archard_volume(groove_coefficient(material, walls_[w].material()), sample.work.contact);
  } else {
    const wear::Laws& laws = wear_laws(material, walls_[w].material());
    wear::add_work(laws, sample.work, sample.volumes);
    wear::add_expression(laws, sample.work, sample.load, sample.volumes);
    if (sample.strikes) {
      wear::add_impact(laws, sample.impact, sample.volumes);
      if (laws.strikes()) account_[w].impacts.add(sample.impact, sample.volumes);
    }
    for (std::size_t m = 0; m < sample.volumes.size(); ++m) account_[w].law[m] += sample.volumes[m];
  }
  contact.book(walls_[w], records, record, sample, map);
  return wear::total(sample.volumes);
}

/// Of all walls and materials, once the laws, accounts and maps are known.
void Simulation::find_uses_of_wear() {
  const std::size_t materials = setup_.materials.size();
  no_wear_.assign(walls_.size() * materials, WearUse::none);
  wear_use_ = no_wear_;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t m = 0; m < materials; ++m) {
      const int material = static_cast<int>(m);
      WearUse& use = wear_use_[w * materials + m];
      if (groove_coefficient(material, walls_[w].material()) != 0.0) use = WearUse::sliding;
      if (by_laws_[w] != 0 || map_layer(w, material).layer != nullptr) use = WearUse::all;
    }
}

/// What the law would wear off an analytic plane, which keeps its shape [m^3].
double Simulation::plane_wear(std::size_t w) const {
  const contact::PlaneList& plane = bulk_->walls().planes()[w];
  double volume = 0.0;
  for (std::size_t k = 0; k < plane.size(); ++k) {
    const auto& s = bulk_->spheres().row[static_cast<std::size_t>(plane.sphere[k])];
    const double alpha_s = wear_coefficient(static_cast<int>(s.material), walls_[w].material());
    volume += wear::archard_volume(alpha_s, {std::max(plane.F_n[k], 0.0), plane.slip[k]});
  }
  return volume;
}

/// The same by several laws. A plane's springs know no first touch but that of this step: it counts at once.
double Simulation::plane_wear_by_laws(std::size_t w) {
  const contact::PlaneList& plane = bulk_->walls().planes()[w];
  const geometry::Pose& pose = poses_[w];
  const Vec3 n = pose.turn(walls_[w].setup().mesh.normal);
  const double level = dot(n, pose.to_world(walls_[w].setup().mesh.position));
  double volume = 0.0;
  for (std::size_t k = 0; k < plane.size(); ++k) {
    if (plane.touching[k] == 0) continue;
    const auto& s = bulk_->spheres().row[static_cast<std::size_t>(plane.sphere[k])];
    const auto material = static_cast<int>(s.material);
    const wear::Laws& laws = wear_laws(material, walls_[w].material());
    const contact::PairProperties& properties = pair(material, walls_[w].material());
    const double elastic =
        contact::hertz_force(properties, s.radius, s.radius - (dot(n, s.position()) - level));
    const Vec3 arm = -s.radius * n;
    Vec3 v = s.velocity() + cross(s.spin(), arm) - pose.velocity_at(s.position() + arm);
    if (walls_[w].is_belt()) v -= pose.turn(walls_[w].belt_velocity(walls_[w].setup().mesh.normal));
    const double v_n = dot(v, n);
    const Vec3 F_t = plane.load[k].force() - plane.F_n[k] * n;
    wear::MechanismVolumes volumes{};
    const wear::WorkSample work{.contact = {std::max(plane.F_n[k], 0.0), plane.slip[k]},
                                .shear_work = norm(F_t) * plane.slip[k],
                                .normal_loss = properties.options.damped_hertz()
                                                   ? std::max((elastic - plane.F_n[k]) * v_n * dt_, 0.0)
                                                   : plane.lost[k]};
    wear::add_work(laws, work, volumes);
    if (laws.expression)
      wear::add_expression(laws, work,
                           {norm(F_t), norm(v - v_n * n), dt_, s.radius, 1.0 / s.inverse_mass, 1.0}, volumes);
    if (plane.fresh[k] != 0 && v_n < 0.0) {
      const double speed = norm(v);
      const wear::Impact impact{speed, std::asin(std::min(1.0, -v_n / speed)), 1.0 / s.inverse_mass,
                                2.0 * s.radius};
      wear::add_impact(laws, impact, volumes);
      if (laws.strikes()) account_[w].impacts.add(impact, volumes);
    }
    for (std::size_t m = 0; m < volumes.size(); ++m) account_[w].law[m] += volumes[m];
    volume += wear::total(volumes);
  }
  return volume;
}

bool Simulation::wears_by_laws() const noexcept {
  return std::ranges::any_of(by_laws_, [](char by) { return by != 0; });
}

wear::MechanismVolumes Simulation::law_volumes(std::size_t wall) const noexcept {
  if (by_laws_[wall] != 0) return account_[wall].law;
  wear::MechanismVolumes volumes{};
  volumes[static_cast<std::size_t>(wear::Mechanism::archard)] = law_[wall];
  return volumes;
}

void Simulation::wear_tip(std::size_t p, std::size_t w) {
  const double alpha_s = wear_coefficient(walls_[w].material(), particles_.material[p]);
  if (alpha_s == 0.0) return;
  tip_law_[p] += sphere_walls_[p * walls_.size() + w].wear_tip(
      *tips_[p], walls_[w], alpha_s, pair(particles_.material[p], walls_[w].material()), output_due(),
      {dt_, wears_by_speed(walls_[w])});
}

/// Of what leaves the groove the removed fraction is lost, and the rest is piled up beside the contact.
void Simulation::plough(SphereWall& contact, std::size_t w, const SlidingSphere& sphere,
                        double groove_volume) {
  // Piles may lie apart where many passes share them.
  constexpr double kRevolutions = 24.0, kNearest = 0.5, kFurthest = 8.0;
  const double removed = removed_fraction() * groove_volume, displaced = groove_volume - removed;
  law_[w] += removed;
  displaced_[w] += displaced;
  Wall& wall = walls_[w];
  if (wall.is_plane()) return;
  const geometry::Pose& pose = poses_[w];
  const Vec3 sliding = sphere.v - pose.velocity_at(sphere.x), v = pose.turn_back(sliding);
  // The path over a wall that turns bends, by Coriolis' and the centrifugal acceleration.
  const double speed2 = norm2(sliding);
  const Vec3 turning =
      speed2 > 0.0 ? pose.turn_back(cross(pose.spin, sphere.v + sliding)) * (-1.0 / speed2) : Vec3{};
  const double n = wearing_revolutions();
  const wear::Ploughing ploughing{removed_fraction(), std::tan(setup_.ploughing->ridge_angle),
                                  setup_.ploughing->ahead};
  contact.plough(
      wall, ploughing,
      {displaced, v, turning, norm(v) * dt_, std::clamp(n / kRevolutions, kNearest, kFurthest), output_due()},
      sphere.R, pair(sphere.material, wall.material()));
}

/// Brings the surfaces' record of worn elements up to date; in the order of particles, so that the sums do
/// not depend on threads.
void Simulation::book_elements() {
  for (std::size_t k = 0; k < sphere_walls_.size(); ++k)
    if (Wall& wall = walls_[k % walls_.size()]; !wall.is_plane()) sphere_walls_[k].book_elements(wall);
  if (!bulk_) return;
  for (BulkWalls::NearMesh& m : bulk_->walls().meshes())
    m.contact->book_elements(walls_[static_cast<std::size_t>(m.wall)]);
}

double Simulation::law_volume() const noexcept {
  double sum = 0.0;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (!walls_[w].is_plane()) sum += law_[w];
  return sum;
}

double Simulation::plane_volume() const noexcept {
  double sum = 0.0;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].is_plane()) sum += law_[w];
  return sum;
}

Ledger Simulation::ledger() {
  Ledger ledger;
  double conserving_law = 0.0, conserving_swept = 0.0, shaping_law = 0.0;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Wall& wall = walls_[w];
    if (wall.is_plane()) {
      ledger.planes += law_[w];
      continue;
    }
    double unpiled = bulk_ ? bulk_->walls().unplaced(w) : 0.0;
    for (std::size_t p = 0; p < particles_.size(); ++p)
      if (wall.setup().deformation == DeformationRule::conserving)
        ledger.paper += sphere_walls_[p * walls_.size() + w].centroid_volume(wall);
    if (bulk_)
      for (BulkWalls::NearMesh& m : bulk_->walls().meshes()) {
        if (static_cast<std::size_t>(m.wall) != w) continue;
        if (wall.setup().deformation == DeformationRule::conserving)
          ledger.paper += m.contact->centroid_volume(wall);
        ledger.deposited += m.contact->pending_volume();
        unpiled += m.contact->unpiled_volume();
      }
    const double swept = wall.surface().swept_volume();
    ledger.law += law_[w];
    if (wall.setup().deformation != DeformationRule::none) shaping_law += law_[w];
    ledger.deposited += wall.surface().deposited_volume();
    for (std::size_t p = 0; p < particles_.size(); ++p) {
      ledger.deposited += sphere_walls_[p * walls_.size() + w].pending_volume();
      unpiled += sphere_walls_[p * walls_.size() + w].unpiled_volume();
    }
    ledger.swept += swept;
    ledger.paper += paper_[w];
    ledger.displaced += displaced_[w];
    ledger.piled += wall.surface().raised_volume();
    ledger.unpiled += unpiled;
    if (wall.setup().deformation == DeformationRule::conserving)
      conserving_law += law_[w] + unpiled, conserving_swept += swept + wall.surface().waiting_volume();
  }
  if (const double groove = ledger.law + ledger.displaced; groove > 0.0) {
    ledger.residual = std::max(std::abs(ledger.deposited - ledger.unpiled - ledger.law),
                               std::abs(conserving_swept - conserving_law)) /
                      groove;
    if (ploughs())
      ledger.residual =
          std::max(ledger.residual, std::abs(ledger.piled + ledger.unpiled - ledger.displaced) / groove);
  }
  if (shaping_law > 0.0) ledger.kappa = ledger.swept / shaping_law;
  for (std::size_t p = 0; p < tips_.size(); ++p) {
    if (!tips_[p]) continue;
    double pending = 0.0;
    for (std::size_t w = 0; w < walls_.size(); ++w)
      pending += sphere_walls_[p * walls_.size() + w].tip_pending();
    ledger.tip_law += tip_law_[p];
    ledger.tip_deposited += tips_[p]->deposited_volume() + pending;
    ledger.tip_removed += tips_[p]->removed_volume() + pending;
  }
  if (ledger.tip_law > 0.0)
    ledger.tip_residual = std::max(std::abs(ledger.tip_deposited - ledger.tip_law),
                                   std::abs(ledger.tip_removed - ledger.tip_law)) /
                          ledger.tip_law;
  return ledger;
}

}  // namespace abradem::simulation
