// The step of a live scene with an envelope: what this chapter and later ones share (see world::make_live).
#pragma once

#include "ch04_multibody_stepping/live.hpp"
#include "ch05_resting_contact/resting.hpp"

namespace fc::resting {

// The scene has an envelope. law: for this world; null: this chapter's. law_effect: the effect that put it there, and whose cost
// is the solver's. Throws as Resting().
world::LiveStep live_step(const Scene& scene, world::World& world, const world::LiveBefore& before,
                          std::unique_ptr<ContactLaw> law = {}, const std::string& law_effect = {});

// A scene without an envelope is live as in chapter 4.
world::LiveChapter live_chapter();

}  // namespace fc::resting
