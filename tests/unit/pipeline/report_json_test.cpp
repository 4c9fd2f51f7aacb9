#include "qmcf/pipeline/report_json.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace qmcf {
namespace {

InspectResult exampleInput() {
  InspectResult result;
  result.repaired.items = {{"duplicateVertices", "merged", 7, {3, 4}}};
  result.repaired.mesh.positions.resize(5);
  result.repaired.mesh.triangles.resize(4);
  Brep& brep = result.brep;
  brep.vertices = {{2, true}};
  brep.edges.resize(3);
  brep.edges[0].kind = EdgeKind::boundary;
  brep.edges[1].length = std::numeric_limits<double>::infinity();
  brep.faces.resize(1);
  brep.faces[0].name =
      "Gr\xf6\xdf"
      "e \"1\"\n";  // Latin-1: not UTF-8.
  brep.faces[0].loops = {{{{0, true, 1.5, 1}}}, {}};
  brep.bodies = {{{0}, true}};
  return result;
}

TEST(ReportJson, InspectResultHasCountsAndElements) {
  const auto json = nlohmann::json::parse(toJson(exampleInput()));
  EXPECT_EQ(json["repair"][0]["defect"], "duplicateVertices");
  EXPECT_EQ(json["repair"][0]["elements"], nlohmann::json({3, 4}));
  EXPECT_EQ(json["counts"]["points"], 5);
  EXPECT_EQ(json["counts"]["loops"], 2);
  EXPECT_EQ(json["counts"]["edges"]["total"], 3);
  EXPECT_EQ(json["counts"]["edges"]["boundary"], 1);
  EXPECT_EQ(json["counts"]["edges"]["sharp"], 2);
  EXPECT_EQ(json["faces"][0]["loops"][0][0]["reversed"], true);
  EXPECT_EQ(json["vertices"][0]["artificial"], true);
  EXPECT_EQ(json["bodies"][0]["faces"], nlohmann::json::array({0}));
}

TEST(ReportJson, NonFiniteNumbersAreNullAndNamesAreUtf8) {
  const auto json = nlohmann::json::parse(toJson(exampleInput()));
  EXPECT_TRUE(json["edges"][1]["length"].is_null());
  EXPECT_EQ(json["faces"][0]["name"],
            "Gr\xef\xbf\xbd\xef\xbf\xbd"
            "e \"1\"\n");
}

TEST(ReportJson, QualityReportKeepsItsFieldNames) {
  QualityReport report;
  report.quads = 12;
  report.sharpRecall = 0.75;
  report.maxAngle.worst = 123.5;
  report.checks = {{"cracks", CheckStatus::warn, 2, {8, 9}, "Two vertices are apart."}};
  report.valid = true;
  report.ledger.interior = {{3, 9, 9}, {5, 1, -1}};
  report.ledger.interiorIndex = report.ledger.fourEuler = 8;
  report.ledger.sheets = 1;
  const auto json = nlohmann::json::parse(toJson(report));
  EXPECT_EQ(json["ledger"]["interior"][0], nlohmann::json({{"elements", 3}, {"vertices", 9}, {"index", 9}}));
  EXPECT_EQ(json["ledger"]["sum"], 8);
  EXPECT_EQ(json["ledger"]["partFourEuler"], nullptr);
  EXPECT_EQ(json["ledger"]["closes"], true);
  EXPECT_EQ(json["quads"], 12);
  EXPECT_EQ(json["sharpRecall"], 0.75);
  EXPECT_TRUE(json["cornerRecall"].is_null());
  EXPECT_EQ(json["maxAngle"]["worst"], 123.5);
  EXPECT_EQ(json["checks"][0]["status"], "warn");
  EXPECT_EQ(json["valid"], true);
}

TEST(ReportJson, ListsAtMostAHundredIds) {
  QualityReport report;
  report.checks = {{"cracks", CheckStatus::fail, 250, std::vector<std::int64_t>(250, 7), "250 vertices are apart."}};
  const auto json = nlohmann::json::parse(toJson(report));
  EXPECT_EQ(json["checks"][0]["elements"].size(), 100U);
  EXPECT_EQ(json["checks"][0]["count"], 250);
}

TEST(ReportJson, WhatWasNotMeasuredIsNull) {
  const auto json = nlohmann::json::parse(toJson(QualityReport{}));
  EXPECT_TRUE(json["scaledJacobian"]["mean"].is_null());
  EXPECT_TRUE(json["triangleScaledJacobian"]["worst"].is_null());
  EXPECT_TRUE(json["regularShare"].is_null());
}

TEST(ReportJson, MeshResultHoldsAllReports) {
  MeshResult result;
  result.input = exampleInput();
  result.size = 0.5;
  result.fieldSingularities = 8;
  result.quality.quads = 3;
  result.faces = {{4, "recombined", "The front could not close.", 10, 2}};
  const auto json = nlohmann::json::parse(toJson(result));
  EXPECT_EQ(json["size"], 0.5);
  EXPECT_EQ(json["fieldSingularities"], 8);
  EXPECT_EQ(json["quality"]["quads"], 3);
  EXPECT_EQ(json["faces"][0]["method"], "recombined");
  EXPECT_EQ(json["repair"][0]["count"], 7);
}

}  // namespace
}  // namespace qmcf
