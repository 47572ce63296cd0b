// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "abradem/contact/hertz_mindlin.h"
#include "abradem/contact/mesh_candidates.h"
#include "abradem/contact/tip_shape.h"

namespace abradem::contact {

/// One connected spot of contact between a sphere and a mesh: one normal, one spring, one Coulomb cone.
struct Patch {
  Vec3 n;                      ///< unit normal, from the surface to the sphere
  double overlap = 0.0;        ///< overlap of a plane with the same weighted overlap volume M [m]
  double elastic_force = 0.0;  ///< K |sum G_T n_T| [N]
  double deepest = 0.0;        ///< largest local overlap R - |x - c| in the patch [m]
};

/// The contact rule `patch`: the force is an integral over the overlapped surface, so it does not know the
/// triangulation. F = K sum_T G_T n_T, with K a function of M alone and such that a plane gives Hertz
/// exactly; so the force is the gradient of a potential and does no work around a closed loop.
/// docs/theory/contact-walls.md
///
/// Two ways to integrate. In general exactly, triangle by triangle. Where the surface is nearly flat and fine
/// against the patch (edges below a third of the disc's radius) over the nodes: the plane through the patch
/// is integrated in closed form, and the nodes only what the surface differs from it. A flat mesh is then
/// exact whatever its nodes, and a worn one to the nodal rule's error times its (small) difference from the
/// plane.
///
/// One object per (sphere, wall); it keeps its arrays from step to step.
class PatchEvaluator {
 public:
  /// Finds the patches of a sphere at c among the candidates (which must be up to date for it).
  /// @param tip worn end of the sphere: its recession is taken from the overlap everywhere
  /// @return valid until the next call; deepest patch first, empty without contact
  std::span<const Patch> evaluate(const MeshCandidates& candidates, const Vec3& c, double R,
                                  const PairProperties& pair, const Tip& tip = {});

  /// 1 - |x - c|^2 / R^2 of each candidate node, from the last evaluation, padded; > 0 inside. With a worn
  /// tip: the excess that has the overlap with it.
  [[nodiscard]] std::span<const double> node_excess() const noexcept { return excess_; }
  /// The same of the sphere as new; of a worn tip only.
  [[nodiscard]] std::span<const double> raw_excess() const noexcept { return raw_; }
  /// Patch of each candidate triangle (index into the last result, -1: none); empty when there is one patch
  /// at most.
  [[nodiscard]] std::span<const int> clusters() const noexcept { return clusters_; }

  /// How fine the triangles of a part are against a contact of radius a: the mean of `fineness` over the
  /// overlapped surface, weighted with the overlap. Of the sphere as new, from the last evaluation.
  /// @param labels,label the part: triangles t with labels[t] == label; no labels: all
  /// @return 0 to 1, continuous in the place of the sphere; negative where the part has no overlap
  [[nodiscard]] double fineness_of(const MeshCandidates& candidates, std::span<const int> labels, int label,
                                   double a) const noexcept;
  /// As if it had never evaluated.
  void forget() noexcept;

  /// What is asked for between two evaluations, for core/archive.h.
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("excess", self.excess_)("correction", self.correction_);
  }
  /// After loading. @param tip the worn end that the next evaluation is for
  void restore(const Tip& tip) noexcept { correction_.restore(tip); }

 private:
  bool evaluate_nodes(const MeshCandidates& candidates, const Vec3& c, double R, const PairProperties& pair);
  void evaluate_triangles(const MeshCandidates& candidates, const Vec3& c, double R,
                          const PairProperties& pair);
  void evaluate_worn(const MeshCandidates& candidates, const Vec3& c, double R, const PairProperties& pair,
                     const Tip& tip);
  void integrate_worn(const MeshCandidates& candidates, const Vec3& c, double R, const Tip& tip);
  void classify(const MeshCandidates& candidates, double R, double limit);
  void add_caps(const MeshCandidates& candidates, std::size_t t, double R);
  void add_rim(const MeshCandidates& candidates, std::size_t t, double R);
  void integrate_rim();
  void integrate_exactly(const MeshCandidates& candidates, const Vec3& c, double R);
  void deepest_points(const MeshCandidates& candidates, double R);
  void single(const MeshCandidates& candidates, std::size_t padded, double R, const PairProperties& pair);
  void cluster(const MeshCandidates& candidates, const Vec3& c, double R, const PairProperties& pair);

  std::vector<double> raw_;  // excess of the sphere as new, where its tip is worn
  TipCorrection correction_;
  const Tip* tip_ = nullptr;  // of the evaluation that is going on; null: the sphere is as new
  std::vector<double> excess_, e0_, e1_, e2_, mean_g_, mean_m_, bound_, inside_, height_;
  std::vector<Patch> patches_;
  std::vector<int> clusters_;  // patch of each triangle; empty: one patch
  std::size_t active_ = 0;     // no triangle from here on overlaps

  /// Triangles that the rim of the ball cuts, turned so that vertex 0 is the odd one out; padded.
  struct Rim {
    std::vector<double> e0, e1, e2, l01, l12, l20, height, inside, g, m;
    std::vector<std::int32_t> triangle;
    std::size_t count = 0;
    void resize(std::size_t capacity);
  } rim_;
  std::vector<std::int32_t> cut_;      // triangles that are not whole, or not small
  std::vector<std::int32_t> general_;  // triangles for the general formula
  std::vector<std::int32_t> deep_;     // triangles whose inside may be deeper than any node
  std::vector<double> scratch_;
  double largest_excess_ = 0.0;  // of the nodes
  double deepest_excess_ = 0.0;  // of the surface
  bool overlaps_ = false;
  bool by_nodes_ = false;  // the last evaluation was nodal: it knows no single triangles
};

/// How fine a triangle of this width is for a contact of radius a: 0 up to a / width = 1/2, 1 from 1 on, with
/// a smooth step between.
[[nodiscard]] double fineness(double a, double width) noexcept;
/// Edge of the equilateral triangle that has the least height of this one [m].
[[nodiscard]] double width_of(const MeshCandidates& candidates, std::size_t t) noexcept;
[[nodiscard]] double width_of(const CandidateTriangle& triangle) noexcept;

/// The patch of an overlap with sum G_T n_T = G [m^3] and weighted overlap volume M [m^4]; without force
/// where they do not make a contact.
[[nodiscard]] Patch make_patch(const Vec3& G, double M, double deepest, double R,
                               const PairProperties& pair) noexcept;

/// Stiffness factor K of F = K sum G_T n_T at an equivalent overlap delta [N/m^3]:
/// 4 E_eff / (3 pi sqrt(R delta) (1 - 2 delta / 3R)).
[[nodiscard]] double patch_stiffness(const PairProperties& pair, double R, double delta) noexcept;

}  // namespace abradem::contact
