// lumenwalk-measure as its users meet it.
#include <gtest/gtest.h>

#include <cmath>

#include "programs/command.h"

namespace lw {
namespace {

TEST(Program, MeasuresTheCubeToAFileAndAReport) {
    const TempFolder folder;
    const Outcome outcome =
        run("measure", {"data/cube.gltf", "--photons", "20000", "--grid", "mid: -2,0,-2 to 2,0,2 task=office",
                        "--ambiance", "half: lamp=0.5", "--ambiance", "full:", "--csv", folder / "s.csv",
                        "--fields-csv", folder / "f.csv", "--report", folder / "r.html", "--camera", "inside"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("fail"), std::string::npos);
    EXPECT_EQ(read_text(folder / "f.csv").substr(0, 11), "field,task,");
    const std::string html = read_text(folder / "r.html");
    EXPECT_NE(html.find("</html>"), std::string::npos);
    EXPECT_EQ(html.find("http"), std::string::npos) << "nothing outside the file";
    EXPECT_EQ(folder.names().size(), 3u);
}

TEST(Program, AnErrorAskedForBakesWithoutAMapAndKeepsTheBake) {
    const TempFolder folder;
    const std::string scene = folder / "cube.gltf", map = folder / "kept.pmap";
    std::filesystem::copy_file(LUMENWALK_SOURCE_DIR "/data/cube.gltf", scene);
    const std::string grid = "mid: -1,0,-1 to 1,0,1 spacing=1";
    const Outcome baked = run("measure", {scene, "--grid", grid, "--error", "3", "--save-map", map});
    EXPECT_EQ(baked.exit_code, 0) << baked.err;
    EXPECT_NE(baked.out.find("million photons"), std::string::npos) << baked.out;
    EXPECT_NE(baked.out.find("wrote " + map), std::string::npos) << baked.out;
    const Outcome again = run("measure", {scene, map, "--grid", grid});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(run("measure", {scene, map, "--grid", grid, "--save-map", folder / "x.pmap"}).exit_code, 2);
    const Outcome nowhere =
        run("measure", {scene, "--grid", grid, "--photons", "2000", "--save-map", folder / "no/x.pmap"});
    EXPECT_EQ(nowhere.exit_code, 1);
    EXPECT_NE(nowhere.err.find("x.pmap"), std::string::npos) << nowhere.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"cube.gltf", "kept.pmap"}));
}

TEST(Program, ComparesItsSensorsWithPathTracing) {
    const TempFolder folder;
    const Outcome outcome =
        run("measure", {"data/cube.gltf", "--photons", "50000", "--grid", "mid: -1,0,-1 to 1,0,1 spacing=0.5",
                        "--reference", "4000", "--csv", folder / "s.csv", "--report", folder / "r.html"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("path traced: "), std::string::npos) << outcome.out;
    EXPECT_NE(read_text(folder / "s.csv").find(",yes,"), std::string::npos);
    EXPECT_NE(read_text(folder / "r.html").find("Compared with path tracing"), std::string::npos);
}

TEST(Program, FindsTheReflectionsOfAViewAndNoneInItsMatteTwin) {
    const TempFolder folder;
    const std::string csv = folder / "r.csv";
    const Outcome bright =
        run("measure", {"data/bad_reflections.gltf", "--reflections", "desk", "--reflections-csv", csv});
    EXPECT_EQ(bright.exit_code, 0) << bright.err;
    EXPECT_NE(bright.out.find("window mirrors desk_2"), std::string::npos) << bright.out;
    EXPECT_NE(bright.out.find("picture mirrors desk_1"), std::string::npos) << bright.out;
    EXPECT_NE(read_text(csv).find("\"window\",\"desk_2\","), std::string::npos);
    const Outcome dark = run("measure", {"data/bad_reflections.gltf", "--reflections", "desk", "--power", "desk_2=0"});
    EXPECT_EQ(dark.out.find("desk_2"), std::string::npos) << dark.out;
    const Outcome matte = run("measure", {"data/bad_reflections_matte.gltf", "--reflections", "desk"});
    EXPECT_NE(matte.out.find(" 0 reflections"), std::string::npos) << matte.out;
    EXPECT_EQ(run("measure", {"data/bad_reflections.gltf", "--reflections", "nowhere"}).exit_code, 1);
    EXPECT_EQ(run("measure", {"data/bad_reflections.gltf", "--reflections-csv", csv}).exit_code, 2);
}

TEST(Program, RefusesBadCommandLinesAndFiles) {
    const TempFolder folder;
    const std::string csv = folder / "s.csv";
    EXPECT_EQ(run("measure", {"data/cube.gltf"}).exit_code, 2);
    EXPECT_EQ(run("measure", {"data/cube.gltf", "--grid", "g: 0,0,0 to 1,0,1", "--rays", "0"}).exit_code, 2);
    const std::vector<std::vector<std::string>> bad = {
        {"data/cube.gltf", "--photons", "2000", "--grid", "g", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--grid", "g: 0,0,0 to 1,0,1 task=nap", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--points", folder / "missing.csv", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--grid", "g: 0,0,0 to 1,0,1", "--ambiance", "a: sun=1", "--csv", csv},
        {"data/cube.gltf", folder / "missing.pmap", "--grid", "g: 0,0,0 to 1,0,1", "--csv", csv},
        {"data/cube.gltf", "--photons", "2000", "--grid", "g: 0,0,0 to 1,0,1", "--ies", "lamp=" + (folder / "no.ies"),
         "--csv", csv}};
    for (const std::vector<std::string>& arguments : bad) {
        const Outcome outcome = run("measure", arguments);
        EXPECT_EQ(outcome.exit_code, 1) << arguments[2];
        EXPECT_NE(outcome.err.find("lumenwalk-measure: "), std::string::npos) << outcome.err;
        EXPECT_TRUE(folder.names().empty());
    }
}

}  // namespace
}  // namespace lw
