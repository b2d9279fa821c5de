// The measurements behind chapter 2's figures: each writes one table (the executable ch02_study).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ch02_hull_hierarchy/study/motions.hpp"
#include "ch02_hull_hierarchy/study/search.hpp"
#include "common/shape.hpp"

namespace fc::hulls {

// A model and how it moves against itself.
struct StudyCase {
  Shape shape;
  Model model;
  double size = 0;  // m
  Lists pieces;     // empty unless asked for
  struct Family {
    std::string name;  // "far", "close"
    std::vector<MotionPair> motions;
  };
  std::vector<Family> families;
};

struct StudyOptions {
  std::filesystem::path out;
  int far = 200, close = 100;  // motions
  bool quiet = false;
};

// The seeds are fixed: the same motions in every run, and the same as in bench_ch02.
StudyCase study_case(const Shape& shape, const StudyOptions& options, bool with_pieces);

// The tolerance where it is not what is varied, as a share of the model's size.
constexpr double kStudyTolerance = 1e-6;

// The options that hulls::advance would use.
TocOptions toc_options(double tolerance);

// The value that is at least as large as this share of the numbers; 0 if there are none.
double quantile(std::vector<double> values, double share);

void study_ideas(const StudyCase& c, const StudyOptions& options);      // ideas.csv
void study_leaves(const StudyCase& c, const StudyOptions& options);     // leaves.csv
void study_tightness(const StudyCase& c, const StudyOptions& options);  // tightness.csv
void study_tolerance(const StudyCase& c, const StudyOptions& options);  // tolerance.csv
void study_triangles(const Shape& shape, const StudyOptions& options);  // triangles.csv
void study_approach(const StudyCase& c, const StudyOptions& options);   // approach.csv
void study_discrete(const StudyCase& c, const StudyOptions& options);   // discrete.csv, contacts.csv
void study_pictures(const StudyCase& c, const StudyOptions& options);   // hulls.csv, visits.csv

}  // namespace fc::hulls
