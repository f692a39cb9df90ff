#include "core/shaders/program.h"

#include <stdexcept>

#include "core/textures/image.h"

namespace pivot {
namespace {

constexpr std::size_t max_inputs = 40;

const Place& nowhere() {
    static const CameraFacts camera{};
    static const PlaceLanes lanes = [] {
        PlaceLanes nothing{};
        nothing.camera = &camera;
        return nothing;
    }();
    static const Place place{
        .lanes = lanes, .position = {}, .normal = {}, .normal_geometric = {}, .barycentric = {}, .position_object = {}};
    return place;
}

void require_settings(const OpKind& kind, const OpSettings& settings) {
    const std::size_t count = settings.numbers.size();
    if (count == kind.setting_count || (count > kind.setting_count && kind.takes_more_settings)) return;
    throw std::invalid_argument("op '" + std::string(kind.name) + "': of settings it takes " +
                                std::to_string(kind.setting_count) + (kind.takes_more_settings ? " or more" : "") +
                                ", not " + std::to_string(count));
}

}  // namespace

std::uint32_t Program::add(const std::string& name, std::vector<Input> inputs, OpSettings settings,
                           std::uint32_t neighbour) {
    const OpKind* kind = find_op(name);
    if (!kind) throw std::invalid_argument("there is no op '" + name + "'");
    const auto fail = [&](const std::string& what) { throw std::invalid_argument("op '" + name + "': " + what); };
    if (inputs.size() != kind->input_count)
        fail("it takes " + std::to_string(kind->input_count) + " numbers, not " + std::to_string(inputs.size()));
    if (inputs.size() > max_inputs) fail("it has too many inputs");
    if (neighbour >= 3 + 2 * bump_widths_.size()) fail("there is no neighbour " + std::to_string(neighbour));
    require_settings(*kind, settings);
    if (kind->reads_image && !settings.image) fail("it needs an image");
    for (const Input& input : inputs)
        if (input.register_index != Input::constant && input.register_index >= register_count_)
            fail("register " + std::to_string(input.register_index) + " holds nothing yet");
    const std::uint32_t first = register_count_;
    steps_.push_back({.kind = kind,
                      .first_input = static_cast<std::uint32_t>(inputs_.size()),
                      .first_output = first,
                      .neighbour = neighbour,
                      .settings = std::move(settings)});
    inputs_.insert(inputs_.end(), inputs.begin(), inputs.end());
    register_count_ += kind->output_count;
    needs_neighbours_ = needs_neighbours_ || neighbour != 0;
    return first;
}

std::uint32_t Program::bump_neighbour(float filter_width) {
    const auto found = std::ranges::find(bump_widths_, filter_width);
    const auto index = static_cast<std::uint32_t>(found - bump_widths_.begin());
    if (index == bump_widths_.size()) bump_widths_.push_back(filter_width);
    return 3 + 2 * index;
}

Program Program::part_for(std::span<const std::uint32_t> registers) const {
    std::vector<bool> is_wanted(register_count_, false);
    for (const std::uint32_t index : registers) is_wanted[index] = true;
    Program part = *this;
    part.steps_.clear();
    part.needs_neighbours_ = false;
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
        const auto outputs = is_wanted.begin() + step->first_output;
        if (std::none_of(outputs, outputs + step->kind->output_count, std::identity())) continue;
        for (std::uint32_t i = 0; i < step->kind->input_count; ++i) {
            const Input& input = inputs_[step->first_input + i];
            if (input.register_index != Input::constant) is_wanted[input.register_index] = true;
        }
        part.steps_.push_back(*step);
        part.needs_neighbours_ = part.needs_neighbours_ || step->neighbour != 0;
    }
    std::ranges::reverse(part.steps_);
    return part;
}

std::vector<std::string_view> Program::ops() const {
    std::vector<std::string_view> names;
    for (const Step& step : steps_) names.push_back(step.kind->name);
    return names;
}

void Program::make_image_levels() const {
    for (const Step& step : steps_)
        if (step.settings.image) step.settings.image->make_levels();
}

void Program::run(Places places, Registers& registers) const {
    registers.resize(std::max<std::size_t>(registers.size(), register_count_));
    std::array<Batch, max_inputs> inputs;
    for (const Step& step : steps_) {
        for (std::uint32_t i = 0; i < step.kind->input_count; ++i) {
            const Input& input = inputs_[step.first_input + i];
            inputs[i] = input.register_index == Input::constant ? Batch(input.value) : registers[input.register_index];
        }
        // Where there are no neighbours each is the place itself.
        const Place& place = places[step.neighbour < places.size() ? step.neighbour : 0];
        step.kind->run(inputs.data(), step.settings, place, &registers[step.first_output]);
    }
}

std::vector<float> Program::run_nowhere() const {
    std::vector<Batch> registers(register_count_);
    run({&nowhere(), 1}, registers);
    std::vector<float> numbers;
    for (const Batch& batch : registers) numbers.push_back(store(batch)[0]);
    return numbers;
}

std::vector<Batch> evaluate(const OpKind& kind, std::span<const Batch> inputs, const OpSettings& settings) {
    require_settings(kind, settings);
    std::vector<Batch> outputs(kind.output_count);
    kind.run(inputs.data(), settings, nowhere(), outputs.data());
    return outputs;
}

}  // namespace pivot
