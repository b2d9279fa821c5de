// An account of one frame as a page must be able to read it (common/live/STREAM.md, "Algorithm").
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "common/algorithm.hpp"

namespace fc_test {

using Json = nlohmann::json;

inline void check_finite(const Json& json, const std::string& where) {
  if (json.is_null()) ADD_FAILURE() << where << ": null, a number that is not finite";
  if (json.is_number()) {
    EXPECT_TRUE(std::isfinite(json.get<double>())) << where;
  }
  if (json.is_structured())
    for (const auto& [key, value] : json.items()) check_finite(value, where + "/" + key);
}

inline void check_role(const Json& json, const std::string& where) {
  static const std::set<std::string> roles = {"a", "b", "now", "past", "good", "bad", "force"};
  EXPECT_TRUE(roles.contains(json.at("role").get<std::string>())) << where;
}

inline void check_point(const Json& json, const std::string& where) {
  ASSERT_TRUE(json.is_array() && json.size() == 3) << where;
  for (const Json& x : json) EXPECT_TRUE(x.is_number()) << where;
}

inline void check_mark(const Json& mark, const std::string& where) {
  const std::string kind = mark.at("kind");
  if (kind == "label") {
    check_point(mark.at("at"), where);
    EXPECT_FALSE(mark.at("text").get<std::string>().empty()) << where;
    return;
  }
  check_role(mark, where);
  if (kind == "point") {
    check_point(mark.at("at"), where);
  } else if (kind == "arrow") {
    check_point(mark.at("from"), where);
    check_point(mark.at("to"), where);
  } else if (kind == "plane") {
    check_point(mark.at("at"), where);
    check_point(mark.at("normal"), where);
    double square = 0;
    for (const Json& x : mark.at("normal")) square += x.get<double>() * x.get<double>();
    EXPECT_NEAR(square, 1, 1e-5) << where;
    EXPECT_GT(mark.at("radius").get<double>(), 0) << where;
  } else if (kind == "line") {
    EXPECT_GE(mark.at("points").size(), 2u) << where;
    for (const Json& p : mark.at("points")) check_point(p, where);
    EXPECT_TRUE(mark.at("closed").is_boolean()) << where;
  } else {
    ASSERT_EQ(kind, "mesh") << where;
    EXPECT_GE(mark.at("points").size(), 3u) << where;
    for (const Json& p : mark.at("points")) check_point(p, where);
    EXPECT_FALSE(mark.at("triangles").empty()) << where;
    for (const Json& t : mark.at("triangles")) {
      ASSERT_EQ(t.size(), 3u) << where;
      for (const Json& i : t) EXPECT_LT(i.get<std::size_t>(), mark.at("points").size()) << where;
    }
  }
}

inline void check_chart(const Json& chart, const std::string& where) {
  EXPECT_FALSE(chart.at("x").get<std::string>().empty()) << where;
  EXPECT_FALSE(chart.at("y").get<std::string>().empty()) << where;
  EXPECT_FALSE(chart.at("curves").empty()) << where;
  for (const Json& curve : chart.at("curves")) {
    check_role(curve, where);
    EXPECT_TRUE(curve.at("steps").is_boolean()) << where;
    EXPECT_FALSE(curve.at("name").get<std::string>().empty()) << where;
    EXPECT_FALSE(curve.at("points").empty()) << where;
    for (const Json& p : curve.at("points")) {
      ASSERT_EQ(p.size(), 2u) << where;
      if (chart.at("log").get<bool>()) {
        EXPECT_GT(p[1].get<double>(), 0) << where;
      }
    }
  }
  for (const Json& mark : chart.at("marks")) {
    ASSERT_EQ(mark.size(), 3u) << where;
    EXPECT_TRUE(mark[2].is_string()) << where;
  }
}

inline void check_step(const Json& step, int bodies, const std::string& where) {
  const std::string text = step.at("text");
  EXPECT_FALSE(text.empty()) << where;
  EXPECT_LT(text.size(), 700u) << where << text;
  for (const char* wrong : {"nan", "inf ", "  ", "{}"})
    EXPECT_EQ(text.find(wrong), std::string::npos) << text;
  if (step.contains("poses"))
    for (const Json& pose : step["poses"]) {
      ASSERT_EQ(pose.size(), 8u) << where;
      EXPECT_GE(pose[0].get<int>(), 0) << where;
      EXPECT_LT(pose[0].get<int>(), bodies) << where;
      double square = 0;
      for (std::size_t k = 4; k < 8; ++k) square += pose[k].get<double>() * pose[k].get<double>();
      EXPECT_NEAR(square, 1, 1e-5) << where;
    }
  if (step.contains("draw"))
    for (const Json& mark : step["draw"]) check_mark(mark, where + text);
  if (step.contains("chart")) check_chart(step["chart"], where + text);
  if (!step.contains("bars")) return;
  EXPECT_FALSE(step["bars"].at("title").get<std::string>().empty()) << where;
  EXPECT_TRUE(step["bars"].at("unit").is_string()) << where;
  EXPECT_FALSE(step["bars"].at("rows").empty()) << where << text;
  for (const Json& row : step["bars"].at("rows")) {
    check_role(row, where);
    EXPECT_TRUE(row.at("value").is_number()) << where;
    EXPECT_TRUE(row.at("label").is_string() && row.at("note").is_string()) << where;
  }
}

// Returns the document.
inline Json check_document(const std::string& text, int bodies, const std::string& name) {
  EXPECT_LT(text.size(), fc::algorithm::kMostBytes) << name;
  const Json document = Json::parse(text);
  check_finite(document, name);
  EXPECT_GE(document.at("frame").get<int>(), 1) << name;
  EXPECT_GT(document.at("t1").get<double>(), document.at("t0").get<double>()) << name;
  EXPECT_FALSE(document.at("parts").empty()) << name;
  int chapter = 0;
  for (const Json& part : document.at("parts")) {
    EXPECT_GE(part.at("chapter").get<int>(), 1) << name;
    EXPECT_LE(part.at("chapter").get<int>(), 6) << name;
    chapter = std::max(chapter, part.at("chapter").get<int>());
    EXPECT_FALSE(part.at("title").get<std::string>().empty()) << name;
    EXPECT_FALSE(part.at("steps").empty()) << name;
    for (const Json& step : part.at("steps"))
      check_step(step, bodies, name + ", chapter " + std::to_string(part["chapter"].get<int>()) + ": ");
  }
  EXPECT_GE(chapter, 4) << name;
  return document;
}

}  // namespace fc_test
