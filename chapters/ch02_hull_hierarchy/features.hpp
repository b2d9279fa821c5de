// The features of two models that are in contact.
#pragma once

#include <vector>

#include "ch01_convex_advancement/query.hpp"
#include "ch02_hull_hierarchy/model.hpp"

namespace fc::hulls {

// All pairs of features within `tolerance` (m) of each other at a pose; `origin_a` (m, world) is A's centre
// of mass. Points are in the world, normals are unit and point from A to B, gaps are signed along the normal
// (slightly negative where shapes that touch exactly overlap by rounding).
//
//   vertex-face                  the vertex lies over the face; the normal is the face's, so it is exact
//                                however small the gap
//   edge-edge                    both nearest points lie inside the edges; the normal is their cross product;
//                                neither edge is flat
//   vertex-edge, vertex-vertex   only where no face and no edge is nearer; the normal joins the points
//
// An edge or vertex takes part only if the normal lies in its cone: moving along a neighbouring face or edge
// must not lead nearer to the other body, else that face or edge is the contact. Equivalent pairs (same
// normal within 1e-6, points within the tolerance) are merged; the result is sorted by kinds and numbers.
// Vertices, edges and faces are numbered as in Model::mesh. If no pair of features passes, the nearest
// witness points are the contact.
//
// For cylinders and cones see curved_features.hpp, and outline.hpp for the numbers of their features. A
// compound's features are those of its parts that lie on the surface of the union, numbered from
// Model::first_name on.
//
// `gap` (optional) receives the certified gap of the two (m) if that is at most the tolerance, and is
// unchanged if not.
std::vector<ca::FeaturePair> contact_features(const Model& a, const Model& b, const ca::PairPose& pose,
                                              const Vec3& origin_a, double tolerance, double* gap = nullptr);

}  // namespace fc::hulls
