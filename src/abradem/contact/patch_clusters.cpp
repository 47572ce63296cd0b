// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/contact/patch.h"
namespace abradem::contact {
void PatchEvaluator::cluster(const MeshCandidates& candidates, const Vec3& c, double R, const PairProperties& pair) { single(candidates,c,R,pair);}
}
