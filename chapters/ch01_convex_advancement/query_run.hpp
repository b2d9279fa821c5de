// Running the queries of a scene and writing their tables: what the executables of chapters 1 and 2 share.
#pragma once

#include <functional>
#include <vector>

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

// Answers each query with `ask`, writes queries.csv, features.csv and, if asked for, certificate.csv, and
// fills the summary. A single query's motion is written too; `add_hulls` (optional) adds to it what it likes.
using Ask = std::function<AdvanceResult(const Motion& a, const Motion& b, const AdvanceOptions& options)>;
void run_queries(const Scene& scene, const std::vector<Shape>& shapes,
                 const std::vector<QueryMotions>& queries, const Ask& ask, const RunContext& context,
                 Summary& summary, const std::function<void(MotionRecording&)>& add_hulls = {});

}  // namespace fc::ca
