// Running the queries of a scene and writing their tables: what the executables of chapters 1 and 2 share.
#pragma once

#include <functional>
#include <vector>

#include "ch01_convex_advancement/linear.hpp"
#include "ch01_convex_advancement/query.hpp"
#include "common/motion_recording.hpp"
#include "common/program.hpp"
#include "common/shape.hpp"

namespace fc::ca {

// The motions of a pair for one query.
struct QueryMotions {
  Motion a, b;
};

// The queries of a scene of two bodies: the bodies' own motions, or one query for each row of the scene's
// motions file (contract 1.4). Throws InputError with the file's line: a missing or unknown column, a wrong
// number of cells, a cell that is not a finite number, a zero quaternion, no rows.
std::vector<QueryMotions> query_motions(const Scene& scene, const std::vector<Shape>& shapes);

// The queries of the scene's `linear` file (contract 1.4). Throws InputError with the file's line.
std::vector<LinearQuery> linear_queries(const Scene& scene);

// Answers each query with `ask`, writes queries.csv, features.csv and, if asked for, certificate.csv, and
// fills the summary. `finish` (optional) sees the answer of a single query.
using Ask = std::function<AdvanceResult(std::size_t query, const AdvanceOptions& options)>;
void run_queries(const Scene& scene, std::size_t queries, const Ask& ask, const RunContext& context,
                 Summary& summary, const std::function<void(const AdvanceResult&)>& finish = {});

// The same for two moving bodies. The motion of a single query is written too; `add_hulls` (optional) may add
// to it.
using AskMotions =
    std::function<AdvanceResult(const Motion& a, const Motion& b, const AdvanceOptions& options)>;
void run_queries(const Scene& scene, const std::vector<Shape>& shapes,
                 const std::vector<QueryMotions>& queries, const AskMotions& ask, const RunContext& context,
                 Summary& summary, const std::function<void(MotionRecording&)>& add_hulls = {});

}  // namespace fc::ca
