// ch01_pictures: the tables from which chapter 1's drawings are made.
#include <CLI/CLI.hpp>

#include "ch01_convex_advancement/study/pictures.hpp"
#include "common/study_program.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  std::filesystem::path out;
  bool quiet = false;
  SceneSource source;
  source.chapter = 1;
  StudyProgram program;
  program.purpose = "Writes the tables from which chapter 1's drawings are made, by the chapter's own code:";
  program.example =
      "build/bin/ch01_pictures --part all chapters/ch01_convex_advancement/scenes/spinning_box.yaml --out "
      "out/ch01/pictures";
  program.all = true;
  program.parts = {{"slabs", "support gaps along some normals", [&] { ca::draw_slabs(out); }},
                   {"gjk", "the simplex after each iteration", [&] { ca::draw_gjk(out); }},
                   {"corners", "how fast the corners of a turning bar move", [&] { ca::draw_corners(out); }},
                   {"turned", "which corner is ahead later", [&] { ca::draw_turned(out); }},
                   {"flight", "where the advancement of the scene's flight looks",
                    [&] { ca::draw_flight(read_scene(source), out); }}};
  program.add_options = [&](CLI::App& app) {
    app.add_option("SCENE", source.file, "The scene of the flight: two bodies")
        ->required()
        ->type_name("FILE");
    app.add_option("--set", source.overrides, "Set one value of the scene (repeatable)")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("KEY.PATH=VALUE");
  };
  return run_study(argc, argv, program, out, quiet);
}
