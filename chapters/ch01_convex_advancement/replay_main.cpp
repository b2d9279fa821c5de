// ch01_replay: checks the certificates that chapter 1's executable wrote.
#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/query_run.hpp"
#include "ch01_convex_advancement/replay_run.hpp"
#include "common/errors.hpp"

namespace {

using namespace fc;

ca::ReplayQuestions questions_of(const Scene& scene, const std::filesystem::path&) {
  const double interval = scene.interval;
  if (scene.linear) {
    auto queries = ca::linear_queries(scene);
    const std::size_t count = queries.size();
    return {count, [=, queries = std::move(queries)](std::size_t q, const auto& answer, const auto& rows) {
              return ca::replay(queries[q], interval, answer, rows);
            }};
  }
  const std::vector<Shape> shapes = build_shapes(scene, false);
  auto queries = ca::query_motions(scene, shapes);
  const std::size_t count = queries.size();
  return {count, [=, a = ca::replay_shape(shapes[scene.bodies[0].shape]),
                  b = ca::replay_shape(shapes[scene.bodies[1].shape]),
                  queries = std::move(queries)](std::size_t q, const auto& answer, const auto& rows) {
            return ca::replay({a, b, queries[q].a, queries[q].b, interval}, answer, rows);
          }};
}

// The same, with the checker of exercise 1.10.
ca::ReplayQuestions clear_questions_of(const Scene& scene, const ca::clear::Pieces& pieces) {
  if (scene.linear)
    throw InputError(*scene.mark("linear"),
                     "corners that fly straight have no clear checker; leave out --clear");
  const std::vector<Shape> shapes = build_shapes(scene, false);
  const auto core_of = [&](int body) {
    const Shape& shape = shapes[scene.bodies[body].shape];
    return std::pair{std::make_shared<ca::ConvexCore>(shape.core.vertices, shape.disks), shape.radius};
  };
  auto queries = ca::query_motions(scene, shapes);
  const std::size_t count = queries.size();
  return {count,
          [=, a = core_of(0), b = core_of(1), interval = scene.interval, check = pieces.check_certificate,
           queries = std::move(queries)](std::size_t q, const auto& answer, const auto& rows) {
            std::vector<ca::Refusal> wrong;
            std::string what = ca::replay_answer(interval, answer, !rows.empty());
            if (what.empty())
              what = check(rows, a.first->convex(a.second), queries[q].a, b.first->convex(b.second),
                           queries[q].b, answer.toc * interval);
            if (!what.empty()) wrong.push_back({-1, what});
            return wrong;
          }};
}

}  // namespace

int main(int argc, char** argv) {
  ca::ReplayProgram program;
  program.chapter = 1;
  program.purpose =
      "Checks the certificate of a run of chapter 1: that every row of certificate.csv is true, and that the "
      "rows together prove what queries.csv says. It uses neither GJK nor the motion bounds, and computes in "
      "long double. Standard error has a line for each row that is refused. Exit code 0: all is proved; 3: "
      "something is not; 2: bad input.";
  program.example =
      "Example:\n"
      "  build/bin/ch01_convex_advancement chapters/ch01_convex_advancement/scenes/spinning_box.yaml "
      "--certificate\n"
      "  build/bin/ch01_replay chapters/ch01_convex_advancement/scenes/spinning_box.yaml out/spinning_box";
  program.questions = questions_of;
  ca::clear::Pieces pieces;
  program.clear_questions = [&](const Scene& scene, const std::filesystem::path&) {
    return clear_questions_of(scene, pieces);
  };
  program.pieces = {ca::clear::slots(pieces).back()};
  return ca::run_replay(argc, argv, program);
}
