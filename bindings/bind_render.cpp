// pivot_core.RenderSettings and Session.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings/names.h"
#include "bindings/register.h"
#include "core/render/session.h"

namespace pivot::bindings {
namespace {

namespace py = pybind11;
using std::string;

void require(bool ok, const char* message) {
    if (!ok) throw py::value_error(message);
}

RenderSettings make_settings(const string& integrator, int samples, std::uint32_t seed, int max_bounces,
                             const string& light_sampling, float error_budget_percent, const string& analytic_method,
                             const string& occlusion, float time_limit_s, int threads, const string& pixel_filter,
                             float filter_width_px, bool transparent_film, bool adaptive, float clamp_indirect,
                             float filter_glossy, const string& indirect, int virtual_lights,
                             const string& virtual_light_method, bool denoising_passes, int max_passages,
                             int max_path_passages, bool surface_passes, int uv_attribute,
                             const std::array<float, 3>& mist, bool mattes, int light_groups, int aovs,
                             const std::array<std::uint32_t, 4>& bounce_limits, bool shadow_catchers,
                             float occlusion_distance_m) {
    require(samples >= 1, "samples must be at least 1");
    require(max_bounces >= 0, "max_bounces must not be negative");
    require(max_passages >= 0, "max_passages must not be negative");
    require(max_path_passages >= 0, "max_path_passages must not be negative");
    require(clamp_indirect >= 0.0f, "clamp_indirect must not be negative");
    require(filter_glossy >= 0.0f, "filter_glossy must not be negative");
    require(error_budget_percent > 0.0f, "error_budget_percent must be above 0");
    require(time_limit_s >= 0.0f, "time_limit_s must not be negative");
    require(virtual_lights >= 1 && virtual_lights <= 1 << 20, "virtual_lights must be in [1, 1048576]");
    require(threads >= 0, "threads must not be negative");
    require(light_groups >= 0, "light_groups must not be negative");
    require(aovs >= 0, "aovs must not be negative");
    require(filter_width_px >= 0.0f && filter_width_px < 100.0f, "filter_width_px must be in [0, 100)");
    return {
        .integrator = from_name<Integrator>(
            "integrator", integrator, {{"MONTE_CARLO", Integrator::monte_carlo}, {"ANALYTIC", Integrator::analytic}}),
        .light_sampling = light_sampling_from(light_sampling),
        .samples = static_cast<std::uint32_t>(samples),
        .adaptive = adaptive,
        .seed = seed,
        .max_bounces = static_cast<std::uint32_t>(max_bounces),
        .bounce_limits = {bounce_limits[0], bounce_limits[1], bounce_limits[2], bounce_limits[3]},
        .max_passages = static_cast<std::uint32_t>(max_passages),
        .max_path_passages = static_cast<std::uint32_t>(max_path_passages),
        .clamp_indirect = clamp_indirect,
        .filter_glossy = filter_glossy,
        .error_budget_percent = error_budget_percent,
        .analytic_method = from_name<AnalyticMethod>("analytic_method", analytic_method,
                                                     {{"AUTO", AnalyticMethod::automatic},
                                                      {"EXACT", AnalyticMethod::exact},
                                                      {"SPTD", AnalyticMethod::sptd},
                                                      {"LTC", AnalyticMethod::ltc}}),
        .occlusion = from_name<Occlusion>(
            "occlusion", occlusion,
            {{"RAY_TRACED", Occlusion::ray_traced}, {"BENT_CONE", Occlusion::bent_cone}, {"NONE", Occlusion::none}}),
        .indirect =
            from_name<Indirect>("indirect", indirect, {{"NONE", Indirect::none}, {"VSGL", Indirect::virtual_lights}}),
        .virtual_lights = static_cast<std::uint32_t>(virtual_lights),
        .virtual_light_method = from_name<VirtualLightMethod>("virtual_light_method", virtual_light_method,
                                                              {{"AUTO", VirtualLightMethod::automatic},
                                                               {"WIDENED", VirtualLightMethod::widened},
                                                               {"ANISOTROPIC", VirtualLightMethod::anisotropic}}),
        .time_limit_s = time_limit_s,
        .threads = threads,
        .filter_shape = pixel_filter_from(pixel_filter),
        .filter_width_px = filter_width_px,
        .transparent_film = transparent_film,
        .denoising_passes = denoising_passes,
        .surface_passes = surface_passes,
        .mattes = mattes,
        .uv_attribute = uv_attribute,
        .light_groups = static_cast<std::uint32_t>(light_groups),
        .aovs = static_cast<std::uint32_t>(aovs),
        .mist = {mist[0], mist[1], mist[2]},
        .shadow_catchers = shadow_catchers,
        .occlusion_distance_m = occlusion_distance_m};
}

py::array_t<float> read(const Session& session, const string& pass_name) {
    const Pass& pass = find_pass(pass_name);
    const Film& film = session.film();
    const std::vector<float> values = film.read(pass);
    return py::array_t<float>({film.height(), film.width(), pass.channels}, values.data());
}

}  // namespace

void register_render(py::module_& module) {
    py::class_<RenderSettings>(module, "RenderSettings", "What the artist sets; see the README's table.")
        .def(py::init(&make_settings), py::kw_only(), py::arg("integrator") = "MONTE_CARLO", py::arg("samples") = 64,
             py::arg("seed") = 0, py::arg("max_bounces") = 4, py::arg("light_sampling") = "JOINT",
             py::arg("error_budget_percent") = 2.0f, py::arg("analytic_method") = "AUTO",
             py::arg("occlusion") = "RAY_TRACED", py::arg("time_limit_s") = 0.0f, py::arg("threads") = 0,
             py::arg("pixel_filter") = "BLACKMAN_HARRIS", py::arg("filter_width_px") = 1.5f,
             py::arg("transparent_film") = false, py::arg("adaptive") = false, py::arg("clamp_indirect") = 0.0f,
             py::arg("filter_glossy") = 0.0f, py::arg("indirect") = "NONE", py::arg("virtual_lights") = 4096,
             py::arg("virtual_light_method") = "AUTO", py::arg("denoising_passes") = false, py::arg("max_passages") = 8,
             py::arg("max_path_passages") = 9, py::arg("surface_passes") = false, py::arg("uv_attribute") = -1,
             py::arg("mist") = std::array<float, 3>{5.0f, 25.0f, 2.0f}, py::arg("mattes") = false,
             py::arg("light_groups") = 0, py::arg("aovs") = 0,
             py::arg("bounce_limits") = std::array<std::uint32_t, 4>{~0u, ~0u, ~0u, ~0u},
             py::arg("shadow_catchers") = false, py::arg("occlusion_distance_m") = 0.0f,
             "bounce_limits: of diffuse, of glossy reflections, of those through surfaces and in media.");
    py::class_<SessionLights, std::shared_ptr<SessionLights>>(
        module, "SessionLights", "What an analytic session gathered, for those to come of the same scene.");
    py::class_<Session>(
        module, "Session",
        "A render by native threads. Sessions may share a scene, which must not be edited until all have ended.")
        .def(py::init([](std::shared_ptr<Scene> scene, const RenderSettings& settings,
                         std::shared_ptr<SessionLights> known) {
                 return std::make_unique<Session>(std::move(scene), settings, std::move(known));
             }),
             py::arg("scene"), py::arg("settings"), py::arg("known_lights") = nullptr,
             "known_lights: of a session before, since when the scene has been edited by set_camera alone; taken over "
             "where this session would gather the same.")
        .def_property_readonly(
            "lights", [](const Session& s) { return std::const_pointer_cast<SessionLights>(s.lights()); },
            "SessionLights; None until they are gathered, and of Monte Carlo.")
        .def("start", &Session::start, py::call_guard<py::gil_scoped_release>(),
             "Starts the threads and returns at once.")
        .def("wait", &Session::wait, py::arg("seconds"), py::call_guard<py::gil_scoped_release>(),
             "Whether the render has ended within the given time; raises what failed in it.")
        .def("stop", &Session::stop, "Ends the render within milliseconds; what is done stays readable.")
        .def_property_readonly("progress", &Session::progress, "0..1")
        .def_property_readonly("sampling_s", &Session::sampling_s,
                               "Since the scene was ready for rays, until the render has ended.")
        .def_property_readonly("samples_done", &Session::samples_done,
                               "Samples complete over the whole window; under adaptive sampling, of those pixels that "
                               "take as many.")
        .def_property_readonly("pixel_samples", &Session::pixel_samples,
                               "Samples so far, of all pixels and of those around the window whose samples reach it.")
        .def_property_readonly("width", [](const Session& s) { return s.film().width(); })
        .def_property_readonly("height", [](const Session& s) { return s.film().height(); })
        .def_static(
            "bytes_per_pixel",
            [](bool adaptive, bool denoising_passes, bool surface_passes, bool mattes, std::size_t named_passes) {
                return Session::bytes_per_pixel(adaptive, {.own_sums = denoising_passes,
                                                           .surface_passes = surface_passes,
                                                           .mattes = mattes,
                                                           .named_passes = named_passes});
            },
            py::arg("adaptive"), py::arg("denoising_passes") = false, py::arg("surface_passes") = false,
            py::arg("mattes") = false, py::arg("named_passes") = 0,
            "What a session allocates for each pixel of its window.")
        .def_property_readonly("bad_samples", &Session::bad_samples,
                               "The first few samples that were not finite and were left out, by pixel and object.")
        .def_property_readonly(
            "virtual_lights",
            [](const Session& s) {
                std::size_t light_count = 0, photon_count = 0;
                float build_s = 0.0f;
                for (const VirtualLights& lights : s.virtual_lights()) {
                    light_count += lights.light_count;
                    photon_count += lights.photon_count;
                    build_s += lights.build_s;
                }
                return py::make_tuple(light_count, photon_count, build_s);
            },
            "How many virtual lights there are, the photons that they are made of, and the seconds that took; once "
            "samples are done.")
        .def(
            "read_mattes",
            [](const Session& session, const string& kind, std::size_t rank) {
                const Film& film = session.film();
                const auto values = film.read_mattes(from_name<MatteKind>("kind", kind,
                                                                          {{"OBJECT", MatteKind::object},
                                                                           {"MATERIAL", MatteKind::material},
                                                                           {"ASSET", MatteKind::asset}}),
                                                     rank);
                return py::array_t<float>({film.height(), film.width(), 4}, values.data());
            },
            py::arg("kind"), py::arg("rank"),
            "With mattes: as float32 (height, width, 4) two ids and the share of the pixel that each has, from this "
            "rank "
            "on, the largest share first.")
        .def(
            "read_shadow_catchers",
            [](const Session& session, const string& kind) {
                const Film& film = session.film();
                const std::size_t first = film.named_passes() - std::min(film.named_passes(), catcher_pass::count);
                const bool is_factor = kind == "FACTOR";
                const std::vector<float> values =
                    is_factor ? shadow_catcher_factor(film, first)
                              : read_catcher_picture(film, first,
                                                     from_name<CatcherPicture>("kind", kind,
                                                                               {{"NOTHING", CatcherPicture::nothing},
                                                                                {"ALPHA", CatcherPicture::alpha},
                                                                                {"WORLD", CatcherPicture::world}}));
                return py::array_t<float>({film.height(), film.width(), is_factor ? 3 : 4}, values.data());
            },
            py::arg("kind"),
            "With shadow_catchers. FACTOR: what others leave of light on these, (height, width, 3). NOTHING, ALPHA or "
            "WORLD: Combined with nothing in their place, with alpha where they lose light, or with the world behind "
            "them, darkened as much.")
        .def(
            "read_named",
            [](const Session& session, std::size_t which) {
                const Film& film = session.film();
                const auto values = film.read_named(which);
                return py::array_t<float>({film.height(), film.width(), 3}, values.data());
            },
            py::arg("which"),
            "As float32 (height, width, 3) the light of one of the light_groups, which the analytic integrator leaves "
            "black, or, counted after these, two of each of the aovs: what shaders give where a camera sees their "
            "surfaces, and, in red, the share of the pixel where they do.")
        .def(
            "read", &read, py::arg("pass_name"),
            "A pass as float32 (height, width, channels), bottom row first. Combined: premultiplied RGBA; Depth along "
            "the camera's axis, 1e10 where nothing is; Normal, Position: world space; DiffCol; Emit; VolumeDir and "
            "VolumeInd: what media scatter to the camera of light that comes to them "
            "straight, and of other light; Indirect, what came by way of other surfaces and media. Of the analytic "
            "integrator, black elsewhere: Method, the colours of the methods taken; Error, the relative error "
            "predicted. With denoising_passes, by Monte Carlo, for a denoiser, of each pixel's own samples, which no "
            "pixel filter shares: Noisy Image and Noisy Indirect, as Combined and Indirect; Denoising Albedo, of all "
            "lobes; Denoising Normal; Direct Variance and Indirect Variance, of Combined without Indirect and of that, "
            "over their colours. With surface_passes: by what surfaces reflect light, over their own colours, "
            "DiffDir, DiffInd, GlossDir, GlossInd, TransDir and TransInd, which the analytic integrator leaves black; "
            "these colours, Diffuse Color, GlossCol and TransCol; Env, what is seen of the world; UV, by the attribute "
            "uv_attribute; Vector, see set_camera; Mist, of (start_m, depth_m, power) mist; IndexOB and IndexMA.");
}

}  // namespace pivot::bindings
