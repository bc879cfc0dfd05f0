// Damaged photometric files: one line that names the file, never a crash or a lamp that is no lamp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/random.h"
#include "photometry/photometry.h"

namespace lw {
namespace {

std::string text_of(const std::string& name) {
    std::ifstream stream(std::string(LUMENWALK_SOURCE_DIR "/data/photometry/") + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// "" when the text is a lamp; what is wrong with it in a line otherwise.
std::string error_of(const std::string& text, const std::string& name) {
    Photometry photometry;
    try {
        photometry = parse_photometry(text, name);
    } catch (const Error& e) {
        const std::string what = e.what();
        EXPECT_EQ(what.rfind(name + ": ", 0), 0u) << what;
        for (const char c : what) EXPECT_GE(static_cast<unsigned char>(c), 32) << what;
        EXPECT_GT(what.size(), name.size() + 5) << what;
        return what;
    }
    const double flux = flux_of(photometry);
    EXPECT_TRUE(std::isfinite(flux) && flux > 0) << flux;
    for (const double candela : photometry.candela) EXPECT_TRUE(std::isfinite(candela) && candela >= 0);
    EXPECT_FALSE(summary_of(photometry).empty());
    return "";
}

struct Damage {
    const char *file, *from, *to;
    const char* message;  // a part of it
};

const Damage damages[] = {
    {"downlight.ies", "TILT=NONE", "TILT=NOWHERE.TLT", "TILT=INCLUDE"},
    {"downlight.ies", "TILT=NONE", "TILT=INCLUDE", "the tilt angles must rise"},
    {"downlight.ies", "TILT=NONE", "TILT", "before TILT="},
    {"downlight.ies", "1 1000 2 37", "-1 1000 2 37", "number of lamps"},
    {"downlight.ies", "1 1000 2 37", "1.5 1000 2 37", "number of lamps"},
    {"downlight.ies", "1 1000 2 37", "1 1e999 2 37", "not a number"},
    {"downlight.ies", "1 1000 2 37", "1 1000 0 37", "multiplier"},
    {"downlight.ies", "1 1000 2 37", "1 1000 -2 37", "multiplier"},
    {"downlight.ies", "1 1000 2 37", "1 1000 1e300 37", "1e12 cd"},
    {"downlight.ies", "2 37 1 1 2", "2 1 1 1 2", "number of vertical angles"},
    {"downlight.ies", "2 37 1 1 2", "2 -37 1 1 2", "number of vertical angles"},
    {"downlight.ies", "2 37 1 1 2", "2 37 0 1 2", "number of horizontal angles"},
    {"downlight.ies", "2 37 1 1 2", "2 37 999999999 1 2", "number of horizontal angles"},
    {"downlight.ies", "2 37 1 1 2", "2 37 1 4 2", "photometric type"},
    {"downlight.ies", "2 37 1 1 2", "2 37 1 1 3", "units"},
    {"downlight.ies", "2 37 1 1 2", "2 38 1 1 2", "must rise"},
    {"downlight.ies", "2 37 1 1 2", "2 36 1 1 2", "horizontal angles of type C"},
    {"downlight.ies", "0.5 1 10", "0 1 10", "ballast"},
    {"downlight.ies", "0.5 1 10", "half 1 10", "not a number"},
    {"downlight.ies", "0 2.5 5 7.5", "0 5 2.5 7.5", "must rise"},
    {"downlight.ies", "0 2.5 5 7.5", "0 2.5 2.5 7.5", "must rise"},
    {"downlight.ies", "0 2.5 5 7.5", "-1 2.5 5 7.5", "vertical angles of type C"},
    {"downlight.ies", "87.5 90", "87.5 195", "vertical angles of type C"},
    {"downlight.ies", "1000.000 992.411", "nan 992.411", "not a number"},
    {"downlight.ies", "1000.000 992.411", "inf 992.411", "not a number"},
    {"downlight.ies", "1000.000 992.411", "-1 992.411", "negative"},
    {"downlight.ies", "1000.000 992.411", "0x10 992.411", "not a number"},
    {"downlight.ies", "1000.000 992.411", "\x1b[31m 992.411", "not a number"},
    {"batwing.ies", "\n0 5 10 15", "\n5 6 10 15", "horizontal angles of type C"},
    {"batwing.ies", "80 85 90", "80 85 191", "angles of type C"},
    {"flood.ies", "-90 -85", "-80 -75.5", "must rise"},
    {"flood.ies", " 37 37 2", " 37 37 3.5", "photometric type"},
    {"washer.ldt", "\n2\r\n24\r\n", "\n7\r\n24\r\n", "symmetry (line 3)"},
    {"washer.ldt", "\n2\r\n24\r\n", "\n2\r\n0\r\n", "number of C planes (line 4)"},
    {"washer.ldt", "\n2\r\n24\r\n", "\n2\r\n23\r\n", "must rise"},
    {"washer.ldt", "\n37\r\n", "\n1\r\n", "number of intensities (line 6)"},
    {"washer.ldt", "\n37\r\n", "\nmany\r\n", "number of intensities (line 6)"},
    {"washer.ldt", "\n80.0\r\n", "\n8.0\r\n", "but it states"},
    {"washer.ldt", "\n80.0\r\n", "\neighty\r\n", "light output ratio (line 23)"},
    {"washer.ldt", "LED\r\n1500", "LED\r\n0", "must be positive"},
    {"washer.ldt", "LED\r\n1500", "LED\r\n", "flux of the lamps"},
    {"washer.ldt", "345\r\n", "375\r\n", "outside 0 to 360"},
    {"washer.ldt", "30\r\n45\r\n", "45\r\n30\r\n", "must rise"},
    {"washer.ldt", "87.5\r\n90\r\n", "87.5\r\n190\r\n", "outside 0 to 180"},
    {"washer.ldt", "254.648", "-254.648", "negative"},
};

TEST(DamagedFiles, SayInOneLineWhatIsWrong) {
    for (const char* file : {"downlight.ies", "batwing.ies", "flood.ies", "washer.ldt"})
        ASSERT_EQ(error_of(text_of(file), file), "");
    for (const Damage& damage : damages) {
        std::string text = text_of(damage.file);
        const size_t at = text.find(damage.from);
        ASSERT_NE(at, std::string::npos) << damage.file << ": " << damage.from;
        text.replace(at, std::string(damage.from).size(), damage.to);
        const std::string error = error_of(text, damage.file);
        EXPECT_NE(error.find(damage.message), std::string::npos)
            << damage.file << ": " << damage.to << ": \"" << error << "\"";
    }
}

TEST(DamagedFiles, CutAtAnyPlaceNeverCrash) {
    for (const char* file : {"downlight.ies", "washer.ldt"}) {
        const std::string text = text_of(file);
        for (size_t size = 0; size < text.size(); size += 7) error_of(text.substr(0, size), file);
        EXPECT_NE(error_of(text.substr(0, text.size() / 2), file), "");
        EXPECT_NE(error_of("", file), "");
    }
}

/// One to four damages: bytes changed, pieces left out, doubled or moved.
std::string damaged(std::string text, Rng& rng) {
    const auto below = [&](size_t n) { return std::min(size_t(rng.next() * float(n)), n - 1); };
    for (size_t times = 1 + below(4); times > 0 && text.size() > 2; --times) {
        const size_t at = below(text.size()), length = 1 + below(std::min<size_t>(text.size() - at, 40));
        static constexpr char likely[] = "0123456789.-+eE \n\r,\t\0n@";
        switch (below(5)) {
            case 0:
                text[at] = char(below(256));
                break;
            case 1:
                text[at] = likely[below(sizeof likely - 1)];
                break;
            case 2:
                text.erase(at, length);
                break;
            case 3:
                text.insert(at, text.substr(at, length));
                break;
            default:
                text.insert(below(text.size()), text.substr(at, length));
        }
    }
    return text;
}

/// As error_of(), but the flux, which takes a while, is left out.
bool is_refused(const std::string& text, const std::string& name) {
    try {
        const Photometry photometry = name.ends_with(".ldt") ? parse_eulumdat(text, name) : parse_lm63(text, name);
        for (const glm::dvec3 d : {glm::dvec3(0, 0, -1), glm::dvec3(0.6, 0, -0.8), glm::dvec3(0, -0.8, 0.6)})
            EXPECT_FALSE(candela_at(photometry, d) < 0);
        return false;
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).rfind(name + ": ", 0), 0u) << e.what();
        EXPECT_EQ(std::string(e.what()).find_first_of("\r\n"), std::string::npos) << e.what();
        return true;
    }
}

TEST(DamagedFiles, TenThousandByChanceAreALampOrALine) {
    size_t refused = 0;
    for (const char* file : {"downlight.ies", "batwing.ies", "flood.ies", "washer.ldt"}) {
        const std::string text = text_of(file);
        for (uint64_t i = 0; i < 2500; ++i) {
            Rng rng(7, 0, i);
            const std::string bad = damaged(text, rng);
            refused += is_refused(bad, file);
            if (i % 25 == 0) error_of(bad, file);
        }
    }
    EXPECT_GT(refused, 1000u);
    EXPECT_LT(refused, 9999u);
}

}  // namespace
}  // namespace lw
