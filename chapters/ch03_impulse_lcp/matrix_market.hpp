// Matrices and vectors in Matrix Market files, the common text format of public test problems.
#pragma once

#include <filesystem>

#include "common/types.hpp"

namespace fc::lcp {

// Reads a dense or sparse matrix (array or coordinate; real or integer; general or symmetric) into a dense
// one. A vector is a matrix of one column. Of a symmetric file either triangle of an entry may be stored, but
// not both. One entry stands in a line; in a line of a vector may be several. Any line ends, and a byte order
// mark. Throws InputError with file, line and column: not such a file, another field or symmetry, a word
// that is no finite number, an index out of range, an entry given twice, too few or too many entries, more
// than 10^8 entries when dense.
MatX read_matrix_market(const std::filesystem::path& file);

// Writes every entry with 17 digits, so that reading gives the same bits; of a symmetric matrix the lower
// triangle. Throws std::runtime_error, naming the file, if that cannot be written.
void write_matrix_market(const std::filesystem::path& file, const MatX& matrix);

}  // namespace fc::lcp
