// The readers of a scene's parts. The tree's keys and values have been checked against the table one by one;
// each reader checks what concerns several keys at once, and throws InputError.
#pragma once

#include "common/scene.hpp"
#include "common/scene_values.hpp"

namespace fc {

// An existing file that a key names, relative to the scene's folder or absolute.
std::filesystem::path resolved_file(const Section& section, const std::string& key,
                                    const SceneSource& source);

// The turn of a body or a part, by `orientation` or by `rotation`.
Quat read_orientation(const Section& placed);

std::vector<ShapeSpec> read_shapes(const Section& scene, const SceneSource& source);

std::vector<PairSpec> read_pairs(const Section& scene, const std::vector<ShapeSpec>& shapes);

// Bodies with their grids expanded.
std::vector<BodySpec> read_bodies(const Section& scene, const std::vector<ShapeSpec>& shapes,
                                  const SceneSource& source);

// The keys that restrict or prescribe a body's motion. Refuse what contradicts the body's other keys, which
// `spec` already has.
void read_freedom(const Section& body, BodySpec& spec);
void read_path(const Section& body, const SceneSource& source, BodySpec& spec);

std::vector<ContactSpec> read_contacts(const Section& scene, const std::vector<BodySpec>& bodies);

LcpSpec read_lcp(const Section& lcp, const SceneSource& source);

}  // namespace fc
