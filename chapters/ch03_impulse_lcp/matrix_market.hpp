// Matrices and vectors in Matrix Market files, the common text format of public test problems.
#pragma once

#include <filesystem>

#include "common/types.hpp"

namespace fc::lcp {

// Reads a dense or sparse matrix (array or coordinate; real or integer; general or symmetric) into a dense
// one. A vector is a matrix of one column. In a symmetric file an entry may be stored in either triangle, but
// not in both. A line has one entry; that of a vector may have several. Any line ends; a byte order mark is
// allowed. Throws InputError with file, line and column: not such a file, another field or symmetry, a word
// that is not a finite number, an index out of range, an entry given twice, too few or too many entries, more
// than 10^8 entries when dense.
MatX read_matrix_market(const std::filesystem::path& file);

// Writes every entry with 17 digits, so that reading gives the same bits; for a symmetric matrix, those of
// the lower triangle. Throws std::runtime_error, naming the file, if that cannot be written.
void write_matrix_market(const std::filesystem::path& file, const MatX& matrix);

}  // namespace fc::lcp
