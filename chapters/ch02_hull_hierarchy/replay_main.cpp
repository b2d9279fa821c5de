// ch02_replay: checks the certificates that chapter 2's executable wrote.
#include "ch02_hull_hierarchy/replay.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "ch01_convex_advancement/query_run.hpp"
#include "ch01_convex_advancement/replay_run.hpp"
#include "common/table_reader.hpp"

namespace {

using namespace fc;

// certificate_leaves.csv, query by query: the leaves that its rows are about, and what is wrong with their
// numbering.
struct QueryBlocks {
  std::vector<ca::LeafBlock> blocks;
  std::string wrong;
};
std::vector<QueryBlocks> read_blocks(const std::filesystem::path& run, std::size_t queries) {
  std::vector<QueryBlocks> result(queries);
  const std::filesystem::path file = run / "certificate_leaves.csv";
  if (!std::filesystem::exists(file)) return result;  // no row, no leaves: the rows, if any, are refused
  const ReadTable table = read_table(file, "query,k,first_a,count_a,first_b,count_b");
  for (const ReadTable::Row& row : table.rows) {
    std::array<int, 6> x{};
    for (int c = 0; c < 6; ++c) {
      const double number = table.number(row, c);
      if (!(number >= 0 && number < 2e9 && number == std::floor(number)))
        throw InputError(table.mark(row, c), "must be a whole number, 0 or more");
      x[c] = static_cast<int>(number);
    }
    if (x[0] >= static_cast<int>(queries))
      throw InputError(table.mark(row, 0), "there is no query " + row.cells[0]);
    QueryBlocks& query = result[x[0]];
    if (x[1] != static_cast<int>(query.blocks.size()) && query.wrong.empty())
      query.wrong = fmt::format("{}:{}: row {} of query {} is out of order, or one before it is missing",
                                std::filesystem::path(table.file).filename().string(), row.line, row.cells[1],
                                row.cells[0]);
    query.blocks.push_back({x[2], x[3], x[4], x[5]});
  }
  return result;
}

ca::ReplayQuestions questions_of(const Scene& scene, const std::filesystem::path& run) {
  struct Known {
    std::vector<hulls::Model> models;
    std::vector<ca::QueryMotions> motions;
    std::vector<QueryBlocks> blocks;
    std::string tree;  // what is wrong with one
  };
  const auto known = std::make_shared<Known>();
  const std::vector<Shape> shapes = build_shapes(scene, false);
  for (const Shape& shape : shapes) {
    known->models.push_back(hulls::build_model(shape));
    if (known->tree.empty()) known->tree = hulls::check_tree(known->models.back());
  }
  known->motions = ca::query_motions(scene, shapes);
  known->blocks = read_blocks(run, known->motions.size());
  const int a = scene.bodies[0].shape, b = scene.bodies[1].shape;
  return {known->motions.size(),
          [=, interval = scene.interval](
              std::size_t q, const ca::ReplayAnswer& answer,
              const std::vector<ca::CertificateRow>& rows) -> std::vector<ca::Refusal> {
            if (!known->tree.empty()) return {{-1, known->tree}};
            if (!known->blocks[q].wrong.empty()) return {{-1, known->blocks[q].wrong}};
            return hulls::replay(
                {known->models[a], known->models[b], known->motions[q].a, known->motions[q].b, interval},
                answer, rows, known->blocks[q].blocks);
          }};
}

}  // namespace

int main(int argc, char** argv) {
  ca::ReplayProgram program;
  program.chapter = 2;
  program.purpose =
      "Checks the certificate of a run of chapter 2: that every row of certificate.csv is true of the "
      "leaves that certificate_leaves.csv names, and that the rows together prove every pair of triangles "
      "clear until what queries.csv says. It uses neither GJK nor the motion bounds, and computes in long "
      "double. Standard error has a line for each row that is refused. Exit code 0: all is proved; 3: "
      "something is not; 2: bad input.";
  program.example =
      "Example:\n"
      "  build/bin/ch02_hull_hierarchy chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml --certificate\n"
      "  build/bin/ch02_replay chapters/ch02_hull_hierarchy/scenes/two_bunnies.yaml out/two_bunnies_query";
  program.questions = questions_of;
  return ca::run_replay(argc, argv, program);
}
