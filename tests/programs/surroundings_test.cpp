// The programs in odd surroundings: streams that are closed or full, readers that go away, outputs that are no files,
// names that steer a terminal, a limit of memory. One line and exit status 1, or the same files as ever.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "programs/command.h"
#include "programs/lavapipe.h"

namespace lw {
namespace {

using Words = std::vector<std::string>;

std::string cube() { return LUMENWALK_SOURCE_DIR "/data/cube.gltf"; }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Lines of a shell in which $BIN/lumenwalk-NAME are the programs, $CUBE is a scene and the folder is the working one.
Outcome in_shell(const TempFolder& folder, const std::string& lines) {
    const TempFolder printed;
    const std::string script = "BIN='" LUMENWALK_BINARY_DIR "' CUBE='" + cube() + "'\ncd '" + folder.path().string() +
                               "'\nexec >'" + (printed / "out") + "' 2>'" + (printed / "err") + "'\n" + lines;
    const int status = std::system(script.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(printed / "out"),
            read_text(printed / "err")};
}

void expect_refusal(const Outcome& outcome, const std::string& named) {
    EXPECT_EQ(outcome.exit_code, 1) << named << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, named)) << named << ": " << outcome.err;
}

/// A scene, its map, a picture and the points of many sensors.
class Surroundings : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TempFolder>();
        write_text(*folder / "points.csv", "desk,0,0.1,0\n");
        ASSERT_EQ(in_shell(*folder,
                           "$BIN/lumenwalk-bake $CUBE -o map --photons 2000 &&"
                           "$BIN/lumenwalk-reference $CUBE -o a.exr --size 8x8 --samples 1")
                      .exit_code,
                  0);
    }
    static void TearDownTestSuite() { folder.reset(); }

    static inline std::unique_ptr<TempFolder> folder;
};

TEST_F(Surroundings, StreamsThatAreClosedLeadNowhereAndToNoFileOfTheProgram) {
    const Outcome outcome = in_shell(*folder, R"sh(
        $BIN/lumenwalk-bake $CUBE -o kept --photons 20000000 <&- >&- 2>&- & bake=$!
        for wait in $(seq 100); do [ "$(readlink /proc/$bake/fd/2)" = /dev/null ] && break; sleep 0.05; done
        for stream in 0 1 2; do readlink /proc/$bake/fd/$stream; done
        kill -9 $bake; wait $bake)sh");
    EXPECT_EQ(outcome.out, "/dev/null\n/dev/null\n/dev/null\n");
    EXPECT_EQ(in_shell(*folder, "$BIN/lumenwalk-bake $CUBE -o mute --photons 2000 <&- >&- 2>&-").exit_code, 0);
    EXPECT_TRUE(read_text(*folder / "mute") == read_text(*folder / "map"));
}

TEST_F(Surroundings, WhatCannotBePrintedIsTold) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    for (const char* line :
         {"$BIN/lumenwalk-bake $CUBE -o printed --photons 2000", "$BIN/lumenwalk-compare a.exr a.exr",
          "$BIN/lumenwalk-measure $CUBE map --points points.csv", "$BIN/lumenwalk-screenshot $CUBE --list-lights",
          "$BIN/lumenwalk-reference $CUBE -o printed.exr --size 4x4 --samples 1"})
        expect_refusal(in_shell(*folder, std::string(line) + " >/dev/full"), "what was printed is lost: No space left");
}

TEST_F(Surroundings, AReaderThatGoesAwayDoesNotKeepTablesFromBeingWritten) {
    std::string points;
    for (int i = 0; i < 60; ++i) points += " --points points.csv";  // more lines than a pipe's buffer holds back
    const Outcome outcome =
        in_shell(*folder, "( sleep 0.3; $BIN/lumenwalk-measure $CUBE map --csv table.csv" + points + " ) | exec true");
    EXPECT_TRUE(contains(read_text(*folder / "table.csv"), "desk")) << outcome.err;
}

TEST_F(Surroundings, OutputsThatAreNoFilesStayWhatTheyAre) {
    ASSERT_EQ(mkfifo((*folder / "pipe.exr").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/null", *folder / "nothing.exr");
    for (const char* output : {"pipe.exr", "nothing.exr"}) {
        for (const char* line : {"$BIN/lumenwalk-bake $CUBE --photons 2000 -o ",
                                 "$BIN/lumenwalk-reference $CUBE --size 4x4 --samples 1 -o ",
                                 "$BIN/lumenwalk-compare a.exr a.exr --difference ",
                                 "$BIN/lumenwalk-measure $CUBE map --points points.csv --csv ",
                                 "$BIN/lumenwalk-screenshot $CUBE map --size 4x4 -o "})
            expect_refusal(in_shell(*folder, std::string(line) + output), "is a device or a pipe, not a file");
    }
    EXPECT_TRUE(std::filesystem::is_fifo(*folder / "pipe.exr"));
    EXPECT_TRUE(std::filesystem::is_symlink(*folder / "nothing.exr"));
}

TEST_F(Surroundings, InputsThatHaveNoEndOrAreNoFilesAreRefused) {
    std::filesystem::create_symlink("loop", *folder / "loop");
    ASSERT_EQ(mkfifo((*folder / "pipe").c_str(), 0600), 0);  // which nobody writes to
    for (const char* input : {"/dev/zero", "/dev/null", "/dev/random", "loop", ".", "pipe"})
        for (const char* line :
             {"$BIN/lumenwalk-bake @ -o made", "$BIN/lumenwalk-bake $CUBE -o made --ies lamp=@",
              "$BIN/lumenwalk-reference @ -o made.exr", "$BIN/lumenwalk-compare a.exr @",
              "$BIN/lumenwalk-measure @ --points points.csv", "$BIN/lumenwalk-measure $CUBE @ --points points.csv",
              "$BIN/lumenwalk-measure $CUBE map --points @", "$BIN/lumenwalk-screenshot $CUBE @ -o made.png",
              "$BIN/lumenwalk $CUBE --play @"}) {
            std::string words = line;
            words.replace(words.find('@'), 1, input);
            expect_refusal(in_shell(*folder, words), input);
        }
    EXPECT_FALSE(std::filesystem::exists(*folder / "made"));
}

TEST_F(Surroundings, NamesThatSteerATerminalAreToldInOnePlainLine) {
    for (const char* program : {"bake", "reference", "measure", "screenshot", "compare", ""}) {
        const std::string name = "no\n\x1b[31mscene.png";
        const Words words = std::string(program) == "measure"   ? Words{name, "--points", "points.csv"}
                            : std::string(program) == "compare" ? Words{name, name}
                            : std::string(program).empty()      ? Words{name, "--play", "path.json"}
                                                                : Words{name, "-o", "made.exr"};
        const Outcome outcome = run(program, words);
        expect_refusal(outcome, "no??[31mscene.png");
        EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos) << program;
    }
}

TEST_F(Surroundings, FilesWithOddNamesAreReadAndWritten) {
    const std::string names[] = {"a room",     "-room", "zimmer \xc3\xa4\xe2\x82\xac \xf0\x9f\x92\xa1",
                                 "two\nlines", "100%",  "'quoted'"};
    for (const std::string& name : names) {
        const std::string scene = *folder / (name + ".gltf"), map = *folder / (name + ".pmap");
        std::filesystem::copy_file(cube(), scene);
        EXPECT_EQ(run("bake", {"--photons", "2000", scene}).exit_code, 0) << name;
        EXPECT_TRUE(read_text(map) == read_text(*folder / "map")) << name;
    }
    EXPECT_EQ(in_shell(*folder, "$BIN/lumenwalk-bake --photons 2000 -o made -- -room.gltf").exit_code, 0);
}

/// A locale in which numbers have a comma, made for this test.
TEST_F(Surroundings, ALocaleWithDecimalCommasChangesNoNumber) {
    if (in_shell(*folder, "localedef -i de_DE -f UTF-8 ./de_DE.UTF-8 || [ -d de_DE.UTF-8 ]").exit_code != 0)
        GTEST_SKIP() << "no localedef here";
    for (const char* line : {"$BIN/lumenwalk-bake $CUBE -o @.pmap --photons 2000 --radius 0.25 --neighbour-angle 45.5",
                             "$BIN/lumenwalk-reference $CUBE -o @.exr --size 4x4 --samples 1 --power lamp=0.5",
                             "$BIN/lumenwalk-measure $CUBE map --points points.csv --power lamp=0.5 --csv @.csv"}) {
        std::vector<std::string> files;
        for (const char* before : {"", "LOCPATH=$PWD LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 "}) {
            std::string words = before + std::string(line);
            words.replace(words.find('@'), 1, "number");
            const Outcome outcome = in_shell(*folder, words);
            EXPECT_EQ(outcome.exit_code, 0) << words << ": " << outcome.err;
            const size_t at = words.find("number.");
            files.push_back(read_text(*folder / words.substr(at, words.find(' ', at) - at)));
        }
        EXPECT_FALSE(files[0].empty());
        EXPECT_TRUE(files[0] == files[1]) << line;
    }
}

TEST_F(Surroundings, AnEnvironmentOfNonsenseChangesNoPicture) {
    SKIP_WITHOUT_LAVAPIPE();
    const std::string nonsense =
        "env -u HOME TMPDIR=/nowhere XDG_CACHE_HOME=/nowhere XDG_RUNTIME_DIR=/nowhere LANG=nonsense LC_ALL=xx "
        "COLUMNS=0 TERM= DISPLAY=nonsense WAYLAND_DISPLAY=nonsense LP_NUM_THREADS=-5 TZ=nonsense ";
    const std::string line =
        "$BIN/lumenwalk-screenshot $CUBE map --size 16x12 --samples 1 --gather smooth --device llvmpipe -o ";
    EXPECT_EQ(in_shell(*folder, line + "plain.png").exit_code, 0);
    const Outcome outcome = in_shell(*folder, nonsense + line + "odd.png");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(read_text(*folder / "plain.png") == read_text(*folder / "odd.png"));
    expect_refusal(in_shell(*folder, nonsense + "$BIN/lumenwalk $CUBE map"), "lumenwalk: no display: ");
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool takes_all_addresses = true;
#else
constexpr bool takes_all_addresses = false;
#endif

TEST_F(Surroundings, ALimitOfMemoryIsAskedFirstAndToldWithWhatWouldFit) {
    if (takes_all_addresses) GTEST_SKIP() << "a sanitizer takes more addresses";
    const auto refused = [&](const std::string& line, const std::string& told) {
        expect_refusal(in_shell(*folder, "ulimit -v 2000000\n" + line), told);
    };
    refused("$BIN/lumenwalk-bake $CUBE -o made --photons 64000000", "would fit");
    refused("$BIN/lumenwalk-measure $CUBE --points points.csv --photons 64000000", "would fit");
    refused("$BIN/lumenwalk-reference $CUBE -o made.exr --size 16384x16384", "would fit");
    std::string bytes = read_text(*folder / "map");
    constexpr size_t last_section = 200 - 8;  // of the header's sizes
    uint64_t size = 0;
    std::memcpy(&size, bytes.data() + last_section, 8);
    const uint64_t more = size + 20 * 400'000'000ull;
    std::memcpy(bytes.data() + last_section, &more, 8);
    write_text(*folder / "huge", bytes);
    std::filesystem::resize_file(*folder / "huge", bytes.size() + more - size);  // sparse
    refused("$BIN/lumenwalk-measure $CUBE huge --points points.csv", "huge: the map takes 8.0 GB of memory, there are");
    std::filesystem::remove(*folder / "huge");
    auto scene = nlohmann::json::parse(read_text(cube()));
    scene["images"] = {{{"uri", "data:image/png;base64,UDUgMTUwMDAgMTUwMDAgMjU1Cg=="}}};  // "P5 15000 15000 255": a PGM
    scene["textures"] = {{{"source", 0}}};
    scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    write_text(*folder / "textured.gltf", scene.dump());
    refused("$BIN/lumenwalk-bake textured.gltf -o made", "image 0: the textures take 3.6 GB, there are");
    EXPECT_EQ(in_shell(*folder, "ulimit -v 2000000\n$BIN/lumenwalk-bake $CUBE -o made --photons 2000").exit_code, 0);
}

TEST_F(Surroundings, APictureThatIsTooLargeForTheDeviceIsToldWithWhatWouldFit) {
    SKIP_WITHOUT_LAVAPIPE();
    const auto shot = [&](const std::string& size) {
        return in_shell(*folder,
                        "$BIN/lumenwalk-screenshot $CUBE map -o made.png --samples 1 --gather smooth "
                        "--device llvmpipe --device-memory 0.05 --size " +
                            size);
    };
    const Outcome outcome = shot("4000x3000");
    expect_refusal(outcome, "a picture of 4000x3000 takes about ");
    const size_t end = outcome.err.find(" would fit"), at = outcome.err.rfind(' ', end - 1) + 1;
    EXPECT_EQ(shot(outcome.err.substr(at, end - at)).exit_code, 0) << outcome.err;
}

TEST(CommandLines, WithNumbersThatAreNoneAreRefusedWith2) {
    const std::string points = "/nowhere/points.csv";
    const std::vector<std::pair<std::string, Words>> options = {
        {"measure",
         {"--maintenance", "--error", "--reflections-step", "--min-luminance", "--min-ratio", "--min-solid-angle"}},
        {"reference", {"--caustic-radius", "--time", "--error"}},
        {"screenshot", {"--followed-roughness", "--exposure", "--device-memory"}},
        {"bake", {"--neighbour-angle", "--radius", "--memory"}},
        {"", {"--exposure", "--device-memory"}}};
    for (const auto& [program, names] : options)
        for (const std::string& name : names)
            for (const char* value : {"nan", "-nan", "inf", "-inf", "1e999", "", "five"}) {
                Words words{cube(), name + "=" + value};
                if (program == "measure") words.insert(words.end(), {"--points", points});
                if (program == "reference" || program == "screenshot")
                    words.insert(words.end(), {"-o", "/nowhere/x.exr"});
                if (program.empty()) words.insert(words.end(), {"--play", "/nowhere/path.json"});
                EXPECT_EQ(run(program, words).exit_code, 2) << program << " " << name << "=" << value;
            }
}

TEST(CommandLines, WithPowersBeyondAllLampsAreRefused) {
    for (const char* power : {"lamp=3e38", "lamp=1e13", "lamp=nan", "lamp=inf", "lamp=-0.1", "lamp="})
        for (const char* program : {"reference", "screenshot"})
            expect_refusal(run(program, {cube(), "-o", "/nowhere/x.exr", "--power", power}), "--power lamp=");
}

}  // namespace
}  // namespace lw
