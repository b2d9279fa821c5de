// What a live scene offers to a page: effects to switch, and knobs to turn.
#pragma once

#include "ch04_multibody_stepping/live.hpp"

namespace fc::world {

// Whether a scene key can change while the scene runs; all others begin it again.
bool changes_live(const std::string& key);

// The effects that are on, and those that the scene could have.
std::vector<live::EffectState> effects_offered(const LiveChapter& chapter, const Scene& scene,
                                               const World& world);
// What is off is switched on with this scene's values, where it has them.
void offer_values_of(const Scene& scene, std::vector<live::EffectState>& effects);

std::vector<live::Knob> knobs_offered(const LiveChapter& chapter, const Scene& scene, const World& world,
                                      const LiveStep& step);

// m: the diagonal of the box around the bodies that can be moved (of all, if there is none).
double size_of(const World& world);

}  // namespace fc::world
