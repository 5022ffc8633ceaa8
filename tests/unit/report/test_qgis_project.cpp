// The QGIS project: no foreign words are evaluated.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "report/qgis_template_gdal.hpp"

using namespace talus;

namespace {

QgisTemplate shipped() {
  return {"project.qgs", read_file(TALUS_SOURCE_DIR "/tools/report/project.qgs")};
}

QgisProject project_of(const std::string& title, const std::string& statement) {
  QgisProject project;
  project.words = {{"title", title},
                   {"statement", statement},
                   {"run_id", "1f"},
                   {"author", "A. Muster"},
                   {"date", "2026-05-31"}};
  project.extent = {100, 200, 900, 700};
  return project;
}

// A template with a map and one label.
QgisTemplate small(const std::string& label, const std::string& attributes = "") {
  return {"office.qgs",
          "<qgis>\n<Layouts><Layout name=\"Plan\">\n<LayoutItem type=\"65639\" id=\"Map\" "
          "size=\"200,100,mm\"/>\n<LayoutItem type=\"65641\" id=\"Note\" " +
              attributes + " labelText=\"" + label + "\"/></Layout></Layouts></qgis>"};
}

std::string label_of(const std::string& xml) {
  const std::size_t at = xml.find("labelText=\"") + 11;
  return xml.substr(at, xml.find('"', at) - at);
}

bool has(const std::string& xml, const std::string& part) {
  return xml.find(part) != std::string::npos;
}

// The message that refuses the template.
std::string refusal(const QgisTemplate& from) {
  try {
    static_cast<void>(qgis_project_xml(project_of("a", "b"), from));
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "";
}

}  // namespace

// QGIS evaluates [% ... %] in labels: a site's name must not be an expression, nor XML.
TEST(QgisProject, LetsNoWordsOfOthersBeEvaluated) {
  const QgisProject project =
      project_of("[% @user_account_name %] <b>\"a\"", "[[%% env('HOME') %]");
  const std::string xml = qgis_project_xml(project, shipped());
  EXPECT_TRUE(has(xml, "<title>[ % @user_account_name %] &lt;b&gt;"));
  EXPECT_FALSE(has(xml, "[% @user_account_name"));
  EXPECT_FALSE(has(xml, "[% env"));
  EXPECT_FALSE(has(xml, "[%% env"));
  EXPECT_EQ(label_of(qgis_project_xml(project, small("{title}"))),
            "[ % @user_account_name %] &lt;b&gt;&quot;a&quot;");
}

TEST(QgisProject, WordsMakeNoExpressionWithWhatStandsBesideThem) {
  EXPECT_EQ(label_of(qgis_project_xml(project_of("% 1 + 1 %]", ""), small("[{title}"))),
            "[ % 1 + 1 %]");
  EXPECT_EQ(label_of(qgis_project_xml(project_of("[", "% 1 + 1 %]"), small("{title}{statement}"))),
            "[ % 1 + 1 %]");
  EXPECT_EQ(label_of(qgis_project_xml(project_of("[", ""), small("{title}% 1 + 1 %]"))),
            "[ % 1 + 1 %]");
  EXPECT_EQ(label_of(qgis_project_xml(project_of("a", ""), small("[% 1 + 1 %]{title}"))),
            "[% 1 + 1 %]a");
}

TEST(QgisProject, WordsInAnHtmlLabelAreText) {
  const std::string xml =
      qgis_project_xml(project_of("<img src='a'>", ""), small("{title}", "htmlState=\"1\""));
  EXPECT_EQ(label_of(xml), "&amp;lt;img src='a'&amp;gt;");
}

TEST(QgisProject, LayersCannotBeExpressionsInTheLegend) {
  QgisProject project = project_of("a", "b");
  project.layers = {{"[% 1 %]", "[% 2 %]", "a.tif", QgisLayer::hillshade, "", true}};
  EXPECT_FALSE(has(qgis_project_xml(project, small("")), "[%"));
}

// Items of a sheet that an authority looks for.
TEST(QgisProject, LayoutHasGridNorthScaleAndATitleBlock) {
  QgisProject project = project_of("a slope", "one line\nand another");
  project.contour_interval = 20;
  project.layers = {{"Terrain", "contours", "trn.tif", QgisLayer::contours, "", true},
                    {"Hazard", "Speed [m/s]", "maps/velocity.tif", QgisLayer::raster, "", true}};
  const std::string xml = qgis_project_xml(project, shipped());
  for (const char* part :
       {"<ComposerMapGrid ", "intervalX=\"200\"", "id=\"North\"", "id=\"Scale\"", "Scale 1 : [%",
        "Prepared by:  [%", "<value>client</value>", "<value>A. Muster</value>", "Assessed:  [%",
        "no hazard zoning by itself", "contour-interval=\"20\"", "contour-index-interval=\"100\"",
        "name=\"Speed [m/s]\"", "<value>one line\nand another</value>", "numUnitsPerSegment=\"50\"",
        "unitLabel=\"m\""})
    EXPECT_TRUE(has(xml, part)) << part;
  EXPECT_FALSE(has(xml, "{title}") || has(xml, "{statement}"));
}

TEST(QgisProject, MapsShowTheSiteInTheirOwnShape) {
  const std::string xml = qgis_project_xml(project_of("a", "b"), small("{title}\n{run_id}"));
  EXPECT_TRUE(has(xml, "xmin=\"0\" ymin=\"200\" xmax=\"1000\" ymax=\"700\""));
  EXPECT_EQ(label_of(xml), "a&#xa;1f");
}

TEST(QgisProject, LongScaleBarsCountKilometres) {
  QgisProject project = project_of("a", "b");
  project.extent = {0, 0, 30000, 20000};
  const std::string xml = qgis_project_xml(project, shipped());
  EXPECT_TRUE(has(xml, "unitLabel=\"km\""));
  EXPECT_TRUE(has(xml, "numUnitsPerSegment=\"2\""));
}

TEST(QgisProject, SnapsWhereItsLayersAreEdited) {
  QgisProject project = project_of("a", "b");
  EXPECT_FALSE(has(qgis_project_xml(project, shipped()), "<snapping-settings"));
  project.is_edited = true;
  const std::string xml = qgis_project_xml(project, shipped());
  const std::size_t at = xml.find("<snapping-settings ");
  ASSERT_NE(at, std::string::npos);
  const std::string snapping = xml.substr(at, xml.find('>', at) - at);
  for (const char* part : {" enabled=\"1\"", " mode=\"2\"", " type=\"1\"", " tolerance=\"12\""})
    EXPECT_TRUE(has(snapping, part)) << part;
}

TEST(QgisProject, LayersOfTheTemplateStayAroundThoseOfTheSite) {
  QgisProject project = project_of("a", "b");
  project.layers = {{"Terrain", "hillshade", "trn.tif", QgisLayer::hillshade, "", true}};
  const std::string layout = small("").xml;
  const std::size_t end = layout.find("</qgis>");
  const auto with = [&](const std::string& tree) {
    std::string xml = layout;
    return qgis_project_xml(
        project, {"a.qgs", xml.insert(end, "<layer-tree-group><customproperties/>" + tree +
                                               "</layer-tree-group><projectlayers><maplayer/>"
                                               "</projectlayers>")});
  };
  const std::string parcels = "<layer-tree-layer id=\"parcels\"/>";
  const std::string free = with(parcels);
  EXPECT_LT(free.find("\"Terrain\""), free.find("\"parcels\""));
  const std::string placed = with(parcels + "<layer-tree-group name=\"{layers}\"/>");
  EXPECT_GT(placed.find("\"Terrain\""), placed.find("\"parcels\""));
  EXPECT_FALSE(has(placed, "{layers}"));
  EXPECT_TRUE(has(placed, "<maplayer />") || has(placed, "<maplayer/>"));
}

TEST(QgisProject, FilesOfTheTemplateAreFoundFromWhereItLies) {
  QgisTemplate from = small("");
  from.path = "/office/templates/a.qgs";
  const std::string with =
      "<projectlayers><maplayer><datasource>../parcels.gpkg|layername=a</datasource></maplayer>"
      "<maplayer><datasource>url=https://a.example</datasource></maplayer></projectlayers>";
  from.xml.insert(from.xml.find("</qgis>"), with);
  from.xml.insert(from.xml.find("<LayoutItem"), "<LayoutItem type=\"65640\" file=\"./logo.svg\"/>");
  const std::string xml = qgis_project_xml(project_of("a", "b"), from);
  for (const char* part :
       {"<datasource>/office/parcels.gpkg|layername=a</datasource>",
        "<datasource>url=https://a.example</datasource>", "file=\"/office/templates/logo.svg\""})
    EXPECT_TRUE(has(xml, part)) << part;
}

TEST(QgisProject, LayersSayWhatTheyAreAndWhatElseTheyCanShow) {
  QgisProject project = project_of("a", "b");
  project.run = "run id 1f, Talus 1";
  project.remark = "1 run failed";
  project.layers = {{"Hazard", "Speed", "v.tif", QgisLayer::raster, "<qgis>x</qgis>", true}};
  project.layers[0].about = "speed; in m/s";
  project.layers[0].shown = "largest";
  project.layers[0].other_styles = {{"median", "<qgis a=\"b\">y</qgis>"}};
  project.layers.push_back({"Fences", "Fence", "f.gpkg", QgisLayer::line, "", true});
  project.layers[1].fields = {{"energy_p95_kj", "Energy, 95th percentile [kJ]"}};
  const std::string xml = qgis_project_xml(project, small(""));
  for (const char* part :
       {"<abstract>1 run failed\nspeed; in m/s\nrun id 1f, Talus 1</abstract>",
        "<map-layer-style-manager current=\"largest\">", "<map-layer-style name=\"median\"><qgis ",
        ">y</qgis>", "field=\"energy_p95_kj\" name=\"Energy, 95th percentile [kJ]\""})
    EXPECT_TRUE(has(xml, part)) << part;
}

TEST(QgisProject, TemplatesThatCannotBeFilledAreRefused) {
  EXPECT_EQ(refusal({"a.qgs", "<html/>"}).substr(0, 48),
            "a.qgs: is not a QGIS project: it holds no <qgis>");
  EXPECT_TRUE(has(refusal({"a.qgs", "<qgis><Layouts>"}), "a.qgs: is not a QGIS project: "));
  EXPECT_TRUE(has(refusal({"a.qgs", "<qgis/>"}), "a.qgs: has no print layout, expected one"));
  EXPECT_TRUE(has(refusal({"a.qgs", "<qgis><Layouts><Layout name=\"A\"/></Layouts></qgis>"}),
                  "a.qgs: layout A: has no map item, expected one"));
  QgisTemplate sizeless = small("");
  sizeless.xml.replace(sizeless.xml.find("200,100"), 7, "200");
  EXPECT_TRUE(has(refusal(sizeless), "layout Plan, item Map: has the size \"200,mm\", expected"));
  EXPECT_TRUE(has(refusal({"a.qgs", "<qgis/>"}), "copy report/project.qgs of share/talus"));
}

TEST(QgisProject, UnknownPlaceholdersAreRefusedWithTheirLine) {
  EXPECT_EQ(refusal(small("{titles}")),
            "office.qgs:4: layout Plan, item Note: has {titles}, expected one of {author}, "
            "{date}, {run_id}, {statement}, {title} | did you mean {title}?");
  EXPECT_EQ(refusal(small("[% '{title}' %]")).substr(0, 73),
            "office.qgs:4: layout Plan, item Note: has {title} in an expression of QGI");
  EXPECT_EQ(refusal(small("[% regexp_match('a', 'a{2}b{x}') %] {2} { }")), "");
}
