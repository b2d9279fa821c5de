// ch04_pictures: the runs that chapter 4's drawings show.
#include "ch04_multibody_stepping/study/pictures.hpp"
#include "common/study_program.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  std::filesystem::path out;
  bool quiet = false;
  StudyProgram program;
  program.purpose =
      "Runs the small scenes that chapter 4's drawings show, and writes their tables into --out:";
  program.example = "build/bin/ch04_pictures --part all --out out/ch04/pictures";
  program.parts = {
      {"clocks", "all that the loop does in a frame of four balls (clocks.csv)",
       [&] { world::picture_clocks(out); }},
      {"bounce", "a ball from contact to contact, and in fixed steps (bounce.csv)",
       [&] { world::picture_bounce(out); }},
      {"gaps", "the gaps at which a pair is stopped (gaps.csv)", [&] { world::picture_gaps(out); }},
      {"boxes", "swept boxes, and the pairs that they open (boxes.csv, pairs.csv)",
       [&] { world::picture_boxes(out); }},
      {"island", "what an instant's impact reaches (island.csv, island_contacts.csv)",
       [&] { world::picture_island(out); }},
      {"frozen", "the end of a bouncing ball (frozen.csv, frozen_impacts.csv)",
       [&] { world::picture_frozen(out); }}};
  program.all = true;
  return run_study(argc, argv, program, out, quiet);
}
