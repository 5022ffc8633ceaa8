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
  EXPECT_EQ(n_expressions, 1u);  // the date of printing
}

TEST(QgisProject, SnapsWhereItsLayersAreEdited) {
  QgisProject project;
  project.extent = {0, 0, 100, 100};
  EXPECT_EQ(qgis_project_xml(project).find("<snapping-settings"), std::string::npos);
  project.is_edited = true;
  EXPECT_NE(qgis_project_xml(project).find("<snapping-settings enabled=\"1\""), std::string::npos);
}
