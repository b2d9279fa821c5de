// The runs that chapter 4's drawings show: each writes its own tables into a folder.
#pragma once

#include <filesystem>

namespace fc::world {

void picture_clocks(
    const std::filesystem::path& out);  // clocks.csv: all that the loop does in one frame of four balls
void picture_bounce(
    const std::filesystem::path& out);  // bounce.csv: a ball from contact to contact, and in fixed steps
void picture_gaps(const std::filesystem::path& out);  // gaps.csv: the gaps at which a pair is stopped
void picture_boxes(
    const std::filesystem::path& out);  // boxes.csv, pairs.csv: swept boxes, and the pairs that they open
void picture_island(
    const std::filesystem::path& out);  // island.csv, island_contacts.csv: what one instant's impact reaches
void picture_frozen(
    const std::filesystem::path& out);  // frozen.csv, frozen_impacts.csv: the end of a bouncing ball

}  // namespace fc::world
