// Each type of light against closed forms: emission, flux, light that arrives, pdf, radiance seen, and its traits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "scene/profile.h"
#include "trace/emitter.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr vec3 place(0.2f, -0.1f, 2);                     // of the light
constexpr vec3 aim(0, 0, -1);                             // its direction
constexpr float width = 0.6f, height = 0.4f;              // of the mesh
constexpr float cos_inner = 0.9f, cos_outer = 0.7f;       // of the spot
constexpr std::array<vec3, 2> bounds{vec3(-2), vec3(2)};  // of the scene

std::vector<LightType> all_types() {
    std::vector<LightType> types;
    for (uint type = 0; type < light_type_count; ++type) types.push_back(LightType(type));
    return types;
}

Photometry batwing() { return read_photometry(LUMENWALK_SOURCE_DIR "/data/photometry/batwing.ies"); }

/// Candela over those of the strongest direction, from the file itself.
double share_of_file(vec3 direction) {
    static const Photometry photometry = batwing();
    static const double strongest = [] {
        double most = 0;
        for (double gamma = 0; gamma <= pi; gamma += pi / 360)
            for (double c = 0; c < 2 * pi; c += pi / 72)
                most = std::max(most, candela_at(photometry, {std::sin(gamma) * std::cos(c),
                                                              std::sin(gamma) * std::sin(c), -std::cos(gamma)}));
        return most;
    }();
    return candela_at(photometry, glm::dvec3(direction)) / strongest;
}

/// Adds a rectangle of width x height around `place` that glows towards `aim`.
void add_rectangle(Scene& scene, Light& light) {
    const vec3 u(width, 0, 0), v(0, -height, 0), corner = place - 0.5f * (u + v);
    scene.positions = {corner, corner + u, corner + u + v, corner + v};
    scene.normals.assign(4, aim);
    scene.triangles = {uvec3(0, 1, 2), uvec3(0, 2, 3)};
    scene.triangle_objects = {0, 0};
    scene.objects = {{0, 0}};
    Material glowing{};
    glowing.emissive = light.intensity;
    glowing.emissive_texture.texture = -1;
    scene.materials = {glowing};
    light.area = width * height;
    light.emitter_count = 2;
    scene.emitters = {{0, light.area / 2}, {1, light.area}};
}

Scene scene_with(LightType type) {
    Scene scene;
    scene.bounds = bounds;
    Light light{};
    light.type = type;
    light.intensity = vec3(3, 2, 1);
    light.position = place;
    light.direction = aim;
    light.across = vec3(1, 0, 0);
    switch (type) {
        case light_point:
        case light_directional:
            break;
        case light_spot:
            light.cos_inner = cos_inner, light.cos_outer = cos_outer;
            break;
        case light_mesh:
            add_rectangle(scene, light);
            break;
        case light_profile:
            attach_profile(add_profile(batwing(), false, scene), light);
            break;
    }
    scene.lights = {light};
    return scene;
}

/// Where on the light a photon starts, such that all of [0, 1) x [0, 1) is as likely; nothing for lights at a point.
std::optional<vec2> start_of(LightType type, vec3 origin) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return std::nullopt;
        case light_directional: {
            const vec2 disc = vec2(origin) / (0.5f * length(bounds[1] - bounds[0]) * 1.001f);
            return vec2(dot(disc, disc), std::atan2(disc.y, disc.x) / (2 * lw_pi) + 0.5f);
        }
        case light_mesh:
            return (vec2(origin) - vec2(place)) / vec2(width, height) + 0.5f;
    }
    return std::nullopt;
}

/// Whether the light covers a point of its plane, at an offset from its place.
bool covers(LightType type, vec3 offset) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_directional:
        case light_profile:
            return false;
        case light_mesh:
            return std::abs(offset.x) < width / 2 && std::abs(offset.y) < height / 2;
    }
    return false;
}

/// KHR_lights_punctual.
double falloff(double cosine) {
    const double t = std::clamp((cosine - double(cos_outer)) / double(cos_inner - cos_outer), 0.0, 1.0);
    return t * t;
}

/// lm/sr that leave the whole light towards a unit direction, per unit intensity; 0 for parallel light.
double intensity_of(LightType type, vec3 direction) {
    switch (type) {
        case light_point:
            return 1;
        case light_spot:
            return falloff(double(dot(direction, aim)));
        case light_directional:
            return 0;
        case light_mesh:
            return double(width * height) * std::max(0.0, double(dot(direction, aim)));
        case light_profile:
            return share_of_file(direction);
    }
    return 0;
}

/// lx on a plane with unit `normal` at a point below the light, per unit intensity.
double irradiance_of(LightType type, vec3 point, vec3 normal) {
    const vec3 path = place - point;
    const double d2 = double(dot(path, path)), cosine = double(dot(path, normal)) / std::sqrt(d2);
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return intensity_of(type, normalize(-path)) * cosine / d2;
        case light_directional:
            return double(-dot(aim, normal));
        case light_mesh: {
            // The form factor of the rectangle between the foot of the point and a corner (Howell, C-11), over all four
            // corners; for a plane that is parallel to it.
            const double h = double(path.z);
            double sum = 0;
            for (int sx : {-1, 1})
                for (int sy : {-1, 1}) {
                    const double x = (double(path.x) * sx + double(width) / 2) / h,
                                 y = (double(path.y) * sy + double(height) / 2) / h;
                    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
                    sum += (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / 2;
                }
            return sum;
        }
    }
    return 0;
}

/// Weighted chi-square: counted flux of samples against the expected flux of bins, in standard deviations.
class Bins {
  public:
    explicit Bins(size_t count) : sum_(count, 0), squares_(count, 0), expected_(count, 0) {}
    void count(size_t bin, double flux) { sum_[bin] += flux, squares_[bin] += flux * flux; }
    void expect(size_t bin, double flux) { expected_[bin] += flux; }

    void check(const std::string& what) const {
        double total = 0, chi2 = 0;
        int degrees = -1;
        for (double e : expected_) total += e;
        for (size_t i = 0; i < sum_.size(); ++i) {
            if (expected_[i] < 1e-9 * total) {
                EXPECT_LT(sum_[i], 1e-3 * total) << what << ", bin " << i;
            }
            if (expected_[i] < 1e-4 * total || !(squares_[i] > 0)) continue;
            chi2 += (sum_[i] - expected_[i]) * (sum_[i] - expected_[i]) / squares_[i];
            ++degrees;
        }
        EXPECT_GT(degrees, 10) << what;
        EXPECT_LT(chi2, degrees + 5 * std::sqrt(2.0 * degrees)) << what;
    }

  private:
    std::vector<double> sum_, squares_, expected_;
};

/// Directions in bins of equal solid angle: the cosine to z by the angle around it.
struct DirectionBins {
    static constexpr int rows = 20, columns = 16, fine = 24;
    static size_t bin(vec3 d) {
        const double phi = std::atan2(double(d.y), double(d.x)) / (2 * pi) + 0.5;
        return size_t(std::min(int((double(d.z) + 1) / 2 * rows), rows - 1) * columns +
                      std::min(int(phi * columns), columns - 1));
    }
    /// Calls body(direction, solid angle) for a grid of directions.
    static void for_all(const std::function<void(vec3, double)>& body) {
        for (int r = 0; r < rows * fine; ++r)
            for (int c = 0; c < columns * fine; ++c) {
                const double z = 2 * (r + 0.5) / (rows * fine) - 1, sine = std::sqrt(1 - z * z);
                const double phi = ((c + 0.5) / (columns * fine) - 0.5) * 2 * pi;
                body(vec3(float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(z)),
                     4 * pi / (rows * fine * columns * fine));
            }
    }
};

constexpr int samples = 200'000;

Emission emission(const Emitters& emitters, uint64_t i) {
    Rng rng(5, 1, i);
    std::array<float, 5> u;
    for (float& number : u) number = rng.next();
    return emitters.emit(0, u);
}

TEST(Lights, EveryTypeIsTested) {
    for (const LightType type : all_types()) EXPECT_STRNE(unit_of(type), "") << type;
    EXPECT_STREQ(unit_of(LightType(light_type_count)), "") << "light_type_count is too small";
}

TEST(Lights, EmittedFluxFollowsTheIntensity) {
    for (const LightType type : all_types()) {
        if (comes_from_outside(type)) continue;  // one direction
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        Bins bins(DirectionBins::rows * DirectionBins::columns);
        for (int i = 0; i < samples; ++i) {
            const Emission e = emission(emitters, uint64_t(i));
            ASSERT_NEAR(length(e.direction), 1, 1e-4f);
            bins.count(DirectionBins::bin(e.direction), double(e.flux.y) / samples);
        }
        DirectionBins::for_all([&](vec3 direction, double solid_angle) {
            bins.expect(DirectionBins::bin(direction), intensity_of(type, direction) * solid_angle);
        });
        bins.check(std::string("directions, type ") + std::to_string(type));
    }
}

TEST(Lights, PhotonsStartWhereTheLightIs) {
    constexpr int side = 10;
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const float radius = 0.5f * length(bounds[1] - bounds[0]);
        Bins bins(side * side);
        for (int i = 0; i < samples; ++i) {
            const Emission e = emission(emitters, uint64_t(i));
            if (comes_from_outside(type)) {
                ASSERT_EQ(e.direction, aim);
                ASSERT_GT(dot(e.origin, -aim), radius);
            } else {
                ASSERT_FLOAT_EQ(e.origin.z, place.z);
            }
            const std::optional<vec2> at = start_of(type, e.origin);
            ASSERT_EQ(at.has_value(), !is_at_point(type));
            if (!at) {
                ASSERT_EQ(e.origin, place);
                continue;
            }
            ASSERT_TRUE(at->x > -1e-4f && at->x < 1 + 1e-4f && at->y > -1e-4f && at->y < 1 + 1e-4f);
            const ivec2 cell = clamp(ivec2(*at * float(side)), ivec2(0), ivec2(side - 1));
            bins.count(size_t(side * cell.y + cell.x), 1.0 / samples);
        }
        for (size_t i = 0; i < side * side; ++i) bins.expect(i, 1.0 / (side * side));
        if (!is_at_point(type)) bins.check("places, type " + std::to_string(type));
    }
}

TEST(Lights, FluxIsTheIntegralOfTheIntensity) {
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        double flux = 0, emitted = 0;
        DirectionBins::for_all([&](vec3 direction, double angle) { flux += intensity_of(type, direction) * angle; });
        if (comes_from_outside(type)) flux = pi * std::pow(0.5 * double(length(bounds[1] - bounds[0])), 2);
        for (int i = 0; i < samples; ++i) emitted += double(emission(emitters, uint64_t(i)).flux.y) / samples;
        EXPECT_NEAR(double(emitters.unit_flux(0)) / flux, 1, 0.003) << type;
        EXPECT_NEAR(double(unit_flux(scene, scene.lights[0])) / flux, 1, 0.003) << type;
        EXPECT_NEAR(emitted / flux, 1, 0.005) << type;
    }
}

TEST(Lights, SamplesThatArriveGiveTheIrradianceOfTheClosedForm) {
    constexpr int side = 200;
    const vec3 normal(0, 0, 1);
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const LightReader text(scene);
        for (const vec3 point : {vec3(0.2f, -0.1f, 1), vec3(0, 0, 0), vec3(0.9f, 0.3f, 0.7f), vec3(-1, -1.2f, 0.5f)}) {
            double arriving = 0, shaded = 0;
            for (int i = 0; i < side * side; ++i) {
                const vec2 u((float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side);
                if (const auto in = emitters.arrive(0, point, u.x, u.y))
                    arriving += double(in->radiance.y * dot(in->to_light, normal)) /
                                (in->pdf > 0 ? double(in->pdf) : 1.0) / (side * side);
                const LightSample sample = text.sample_light(scene.lights[0], point, u);
                shaded += double(sample.irradiance.y * dot(sample.to_light, normal)) / (side * side);
            }
            const double expected = irradiance_of(type, point, normal);
            EXPECT_NEAR(arriving, expected, 2e-3 * expected + 1e-6) << type << " at " << point.x;
            EXPECT_NEAR(shaded, expected, 2e-3 * expected + 1e-6) << type << " at " << point.x;
        }
    }
}

TEST(Lights, DirectionsOfSamplesThatArriveFollowTheirPdf) {
    const vec3 point(0.1f, 0, 1.8f);  // close: the light fills many bins
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        if (is_delta(type)) {
            const auto first = emitters.arrive(0, point, 0.1f, 0.2f), second = emitters.arrive(0, point, 0.8f, 0.7f);
            ASSERT_TRUE(first && second) << type;
            EXPECT_EQ(first->to_light, second->to_light) << type;
            EXPECT_EQ(first->pdf, 0) << type;
            continue;
        }
        Bins bins(DirectionBins::rows * DirectionBins::columns);
        for (int i = 0; i < samples; ++i) {
            Rng rng(5, 2, uint64_t(i));
            const float u = rng.next(), v = rng.next();
            const auto in = emitters.arrive(0, point, u, v);
            ASSERT_TRUE(in);
            bins.count(DirectionBins::bin(in->to_light), 1.0 / samples);
        }
        double integral = 0;
        Surface there{};
        there.geometric_normal = aim;
        DirectionBins::for_all([&](vec3 direction, double solid_angle) {
            const float distance = (place.z - point.z) / direction.z;
            const vec3 offset = point + direction * distance - place;
            if (distance <= 0 || !covers(type, offset)) return;
            const double pdf = double(emitters.arrive_pdf(there, distance, direction));
            integral += pdf * solid_angle;
            bins.expect(DirectionBins::bin(direction), pdf * solid_angle);
        });
        EXPECT_NEAR(integral, 1, 0.01) << type;
        bins.check("arriving, type " + std::to_string(type));
    }
}

TEST(Lights, SurfacesShowTheirRadianceToTheirFrontAlone) {
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        EXPECT_EQ(has_surface(type), !scene.emitters.empty()) << type;
        if (!has_surface(type)) continue;
        Surface s = SurfaceReader(scene).surface_at(0, vec2(0.3f));
        EXPECT_EQ(s.light, 0);
        EXPECT_EQ(emitters.radiance(s, aim), vec3(1)) << type;
        EXPECT_EQ(emitters.radiance(s, -aim), vec3(0)) << type;
        s.flags |= material_double_sided;
        EXPECT_EQ(emitters.radiance(s, -aim), vec3(1)) << type;
        s.light = -1;
        EXPECT_EQ(emitters.radiance(s, aim), vec3(0)) << type;
    }
}

TEST(Lights, TraitsTellWhatSamplesDo) {
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const vec3 point(0, 0, 1);
        const auto in = emitters.arrive(0, point, 0.3f, 0.6f);
        ASSERT_TRUE(in) << type;
        EXPECT_EQ(is_delta(type), in->pdf == 0) << type;
        EXPECT_EQ(is_at_point(type), in->position == place) << type;
        const float radius = 0.5f * length(bounds[1] - bounds[0]);
        EXPECT_EQ(comes_from_outside(type), length(in->position) > radius) << type;
        EXPECT_EQ(has_table(type), !scene.texels.empty()) << type;
    }
}

TEST(Lights, CellsHoldLightThatIsLinearNearby) {
    constexpr float step = 0.05f;  // 40 steps from the light: the curvature of 1 / d^2 is below 1 %
    for (const LightType type : all_types()) {
        if (!is_linear_in_cells(type)) continue;
        EXPECT_TRUE(is_delta(type)) << type;
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const auto lux = [&](vec3 p) {
            const auto in = emitters.arrive(0, p, 0, 0);
            return in ? double(in->radiance.x * in->to_light.z) : 0.0;
        };
        int held = 0;
        for (float x = -1.5f; x < 1.5f; x += step) {
            const vec3 a(x, 0, 0), b(x + step, 0, 0), middle(x + step / 2, 0, 0);
            if (!is_fully_lit(scene.lights[0], a) || !is_fully_lit(scene.lights[0], b)) continue;
            EXPECT_NEAR((lux(a) + lux(b)) / 2 / lux(middle), 1, 0.01) << type << " " << x;
            ++held;
        }
        EXPECT_GT(held, 10) << type;
    }
}

}  // namespace
}  // namespace lw
