#include <gtest/gtest.h>

#include "report/qgis_project.hpp"

using namespace talus;

// QGIS evaluates [% ... %] in labels: a site's name must not be an expression, nor XML.
TEST(QgisProject, LetsNoWordsOfOthersBeEvaluated) {
  QgisProject project;
  project.title = "[% @user_account_name %] <b>\"a\"";
  project.layout_lines = {"[[%% env('HOME') %]"};
  project.extent = {0, 0, 100, 100};
  const std::string xml = qgis_project_xml(project);
  const std::size_t layout = xml.find("<Layout ");
  ASSERT_NE(layout, std::string::npos);
  const std::string labels = xml.substr(layout);
  EXPECT_NE(labels.find("[ % @user_account_name"), std::string::npos);
  EXPECT_NE(labels.find("&lt;b&gt;&quot;a&quot;"), std::string::npos);
  std::size_t n_expressions = 0;
  for (std::size_t at = labels.find("[%"); at != std::string::npos; at = labels.find("[%", at + 1))
    ++n_expressions;
  EXPECT_EQ(n_expressions, 5u);  // date and scale of printing, three fields of the title block
}

// What an authority looks for on a sheet.
TEST(QgisProject, LayoutHasGridNorthScaleAndATitleBlock) {
  QgisProject project;
  project.title = "a slope";
  project.extent = {100, 200, 900, 700};
  project.contour_interval = 20;
  project.layers = {{"Terrain", "contours", "trn.tif", QgisLayer::contours, "", true},
                    {"Hazard", "Speed [m/s]", "maps/velocity.tif", QgisLayer::raster, "", true}};
  const std::string xml = qgis_project_xml(project);
  for (const char* part :
       {"<ComposerMapGrid ", "intervalX=\"200\"", "id=\"North\"", "id=\"Scale\"", "Scale 1 : [%",
        "Prepared by: [%", "<value>client</value>", "no hazard zoning by itself",
        "contour-interval=\"20\"", "contour-index-interval=\"100\"", "name=\"Speed [m/s]\""})
    EXPECT_NE(xml.find(part), std::string::npos) << part;
}

TEST(QgisProject, SnapsWhereItsLayersAreEdited) {
  QgisProject project;
  project.extent = {0, 0, 100, 100};
  EXPECT_EQ(qgis_project_xml(project).find("<snapping-settings"), std::string::npos);
  project.is_edited = true;
  EXPECT_NE(qgis_project_xml(project).find("<snapping-settings enabled=\"1\""), std::string::npos);
}
