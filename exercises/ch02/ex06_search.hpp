// Exercise 2.6: the search over two trees. A piece of the engine: chapters 2 and 4 run on it with --mine.
#pragma once

#include "ch02_hull_hierarchy/hull_model.hpp"

namespace fc::mine {

using hulls::HullModel;
using hulls::HullNode;
using hulls::clear::FirstContact;
using hulls::clear::SearchOptions;

// The first time in [0, options.interval) at which two pieces, one of each body, have come to the target gap.
//
//   a, b      each body's tree is a.tree.nodes, the root first; a.convex(node) is a node as chapter 1's Convex
//   motion_a  velocity_at(t), acceleration_at(t), spin_at(t) (m/s, m/s^2, rad/s, world); constant acceleration and spin.
//             ca::PairPose(motion_a, motion_b, t) is where both are at t
//   options   target, slack, start (m), interval (s), most_looks: see SearchOptions. `looks` may be left alone
//   pieces    chapter 1's: pieces.gap(convex_a, convex_b, pose, accuracy, pieces.closest_point),
//             pieces.speed_bound(n, mover_a, mover_b, duration)
//
// A look computes the gap of one pair of nodes at one time: the time until which that pair is proved clear, by its own looks
// and those of the pairs that it came from. No pair is looked at whose time lies beyond the first contact, or at the
// interval's end.
//
//   contact   two leaves have a certified gap of at most target + slack (at t = 0: of at most options.start), or cannot
//             get on: a leaf pair whose step is 0. `time` and both pieces are set. No pair of pieces had less than the
//             target gap before.
//   clear     no pair does so within the interval; `time` is the interval
//   limit     most_looks did not suffice; until `time` all pairs are clear
//
// `looks` counts the looks, `advances` those that proved a step. A pair of nodes whose room (gap less target) is at most a
// fifth of the sum of their radii is opened: the children of the larger of the two (of the one that is no leaf) wait in its
// place. With more room it waits again.
FirstContact search(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                    const ca::Motion& motion_b, const SearchOptions& options,
                    const ca::clear::Pieces& pieces);

}  // namespace fc::mine
