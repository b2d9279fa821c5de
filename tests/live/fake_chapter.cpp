// A chapter's program whose live scene is the tests' fake one: FC_CHAPTER is its number, FC_STEP_MS how long a step takes.
#include <cstdlib>

#include "common/live/serve.hpp"
#include "common/program.hpp"
#include "fake_scene.hpp"

namespace {

int number(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

int run(const fc::Scene&, const fc::RunContext&, fc::Summary&) {
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  fc::Chapter chapter;
  chapter.number = number("FC_CHAPTER", 4);
  chapter.name = "fake_chapter";
  chapter.purpose = "Serves a scene without physics.";
  chapter.example = "fake_chapter scene.yaml --live";
  chapter.explain = [](const fc::Scene&) { return std::vector<fc::Effect>(); };
  chapter.run = run;
  if (std::getenv("FC_NOT_LIVE") == nullptr)
    chapter.live = [](const fc::SceneSource& source, int port, bool quiet) {
      if (source.overrides == std::vector<std::string>{"fails=1"})
        throw fc::NumericalFailure("no scene at all");
      fc_test::FakeScene scene;
      scene.step_ms = number("FC_STEP_MS", 0);
      return fc::live::serve(scene, port, quiet);
    };
  return fc::run_program(argc, argv, chapter);
}
