// Light distributions of luminaires as their makers measure them: IES LM-63 (1986 to 2019) and EULUMDAT files.
// In the luminaire's own frame it aims along -Z, C0 is +X and C grows towards +Y (EXT_lights_ies); Y is up for types A,
// B.
#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace lw {

struct Photometry {
    enum class Type { A, B, C };
    Type type = Type::C;
    std::vector<double> vertical;    // degrees, rising: from the aim (C), or elevation (A, B)
    std::vector<double> horizontal;  // degrees, rising: planes the file gives; the others follow by symmetry
    std::vector<double>
        candela;               // horizontal after horizontal, `vertical` values each; all factors of the file applied
    double lamp_lumens = 0;    // of all lamps; 0 when the file is absolute
    double stated_output = 0;  // lm that the file says leave the luminaire; 0 when it does not
    double color_temperature = 0;                   // K, 0 when not given
    std::vector<double> tilt_angles, tilt_factors;  // lamp output by tilt of the luminaire, or empty
    std::string name;                               // of the luminaire
    std::string file;                               // what begins messages
    std::filesystem::path tilt_file;                // where TILT= leads, "" when nowhere
    std::vector<std::string> notes;                 // "FILE: what", of what was not quite as the format has it
};

/// Reads a .ldt file as EULUMDAT and any other as LM-63. Throws Error("FILE: line N: what") for anything malformed, and
/// for a file whose integrated flux differs by more than 10 % from the flux it states.
Photometry read_photometry(const std::filesystem::path& path);

/// The same from the text of a file called `name`.
Photometry parse_photometry(const std::string& text, const std::string& name);
/// The two formats, without the check of the flux. `name` begins every message. A file that TILT= names is looked for
/// in `folder`, or nowhere when that is empty.
Photometry parse_lm63(const std::string& text, const std::string& name, const std::filesystem::path& folder = {});
Photometry parse_eulumdat(const std::string& text, const std::string& name);

/// Candela in a unit direction of the luminaire's frame, linear between the file's angles; 0 where it gives none.
double candela_at(const Photometry& photometry, glm::dvec3 direction);

/// Unit direction in the luminaire's frame of angles in degrees as a file of this type has them.
glm::dvec3 direction_of_angles(Photometry::Type type, double horizontal, double vertical);

/// Flux in lm: the integral of candela_at() over the sphere, in closed form.
double flux_of(const Photometry& photometry);

/// Light output ratio: flux of the luminaire over that of its lamps; 0 for an absolute file.
double light_output_ratio(const Photometry& photometry);

/// A line of text for the user: flux, strongest intensity, light output ratio and colour temperature.
std::string summary_of(const Photometry& photometry);

/// The factor of the light output when the luminaire is tilted by this many degrees from straight down; 1 when the file
/// gives none.
double tilt_factor(const Photometry& photometry, double degrees);

}  // namespace lw
