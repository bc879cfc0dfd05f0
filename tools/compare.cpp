// lumenwalk-compare: how far picture A is from its reference B, as text or JSON, and as a difference picture.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "base/error.h"
#include "base/program.h"
#include "base/replaced_file.h"
#include "image/compare.h"
#include "image/exr.h"
#include "image/png.h"

namespace {

struct Options {
    std::string picture, reference, difference, channel;
    bool json = false;
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("A", options.picture, "OpenEXR picture to judge")->required();
    app.add_option("B", options.reference, "OpenEXR reference of the same size")->required();
    app.add_option("--difference", options.difference,
                   "PNG to write: red where A is too bright, blue where too dark, full colour at 20 %; default: none");
    app.add_option("--channel", options.channel,
                   "channel to compare, such as illuminance (lux); default: R, G and B (cd/m2)");
    app.add_flag("--json", options.json, "print one JSON object; default: a line per number");
}

/// One list of names and numbers, for both ways to print.
std::vector<std::pair<const char*, double>> rows(const lw::Comparison& c) {
    return {{"mean_ratio", c.mean_ratio},
            {"bias", c.bias},
            {"rmse_relative", c.rmse_relative},
            {"rel_mse", c.rel_mse},
            {"flip", c.flip},
            {"p95_relative_error_8x8_blur", c.p95_relative_error},
            {"reference_mean", c.reference_mean},
            {"exposure_ev", double(c.exposure_ev)}};
}

void print_text(const lw::Comparison& comparison) {
    for (const auto& [name, value] : rows(comparison)) std::printf("%-28s %.6g\n", name, value);
}

void print_json(const lw::Comparison& comparison) {
    const char* separator = "{";
    for (const auto& [name, value] : rows(comparison)) {
        std::printf("%s\"%s\": %.9g", separator, name, value);
        separator = ", ";
    }
    std::printf("}\n");
}

void run(const Options& options) {
    lw::Image picture = lw::read_exr(options.picture);
    lw::Image reference = lw::read_exr(options.reference);
    const std::filesystem::path inputs[] = {options.picture, options.reference};
    if (!options.difference.empty()) lw::check_can_create(options.difference, inputs);
    try {
        lw::Comparison comparison = lw::compare(picture, reference, options.channel);
        options.json ? print_json(comparison) : print_text(comparison);
    } catch (const lw::Error& e) {
        throw lw::Error(options.picture + " against " + options.reference + ": " + e.what());
    }
    if (!options.difference.empty())
        lw::write_png(options.difference, lw::difference_picture(picture, reference, options.channel));
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{
        "Compares picture A with reference B: mean ratio, bias, RMSE / mean, relMSE, FLIP, and the 95th\n"
        "percentile of the relative error after an 8x8 blur. Refuses pictures of different size."};
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    return lw::run_program("lumenwalk-compare", [&] { run(options); });
}
