// Judges rays by the exact ray oracle.
#pragma once

#include "oracle/exact_rays.hpp"
#include "seen_ray.hpp"

namespace validation {

/// The scene must outlive the judge.
std::unique_ptr<RayJudge> make_exact_judge(const oracle::ExactScene& scene,
                                           const Tolerance& tolerance);

}  // namespace validation
