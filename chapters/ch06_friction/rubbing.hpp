// A scene with friction: what is derived and refused, its effects, and its step while a page touches it.
#pragma once

#include "ch05_resting_contact/live_rest.hpp"
#include "ch05_resting_contact/rest_run.hpp"
#include "ch06_friction/coulomb_law.hpp"

namespace fc::friction {

// Friction needs contacts that last: the envelope is the scene's, or chapter 5's default.
Scene with_envelope(const Scene& scene);

// Throws InputError for keys that have no effect with friction.
void refuse_idle_keys(const Scene& scene);

// The effects for --explain. With a world: of a scene that has an envelope if it has friction.
std::vector<Effect> explain(const Scene& scene);
std::vector<Effect> explain(const Scene& scene, const world::World& world);

// For a live scene: with friction Coulomb's law; without it, as chapter 5 or 4, chosen anew whenever the scene changes.
world::LiveChapter live_chapter();

}  // namespace fc::friction
