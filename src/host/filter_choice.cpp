// SPDX-License-Identifier: Apache-2.0
#include "host/filter_choice.h"

#include <algorithm>
#include <mutex>

#include "base/error.h"
#include "base/log.h"
#include "files/file_bytes.h"
#include "filter/device_chain.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_settings_bytes = std::size_t(1) << 16;
constexpr std::size_t max_background_bytes = std::size_t(256) << 20;

bool is_file(const std::string& text) {
    std::error_code ignored;
    return text.ends_with(".json") || fs::is_regular_file(text, ignored);
}

// Index of the camera with this name or number; cameras.size() if there is none.
std::size_t find_camera(const std::string& name, const std::vector<std::string>& cameras) {
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (name == std::to_string(i) || name == cameras[i])
            return i;
    return cameras.size();
}

bool is_number(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

std::string shown_filter(const std::string& spelling) {
    if (spelling.empty())
        return "unfiltered";
    for (const char* preset : {"default", "paper", "stereo"})
        if (filter::parse_chain(preset).settings.spelling() == spelling)
            return preset;
    return spelling;
}

void check_background(const LoadedFilter& filter, Size depth) {
    if (!filter.background || filter.background->nearest.size == depth)
        return;
    const auto text = [](Size size) {
        return std::to_string(size.width) + "x" + std::to_string(size.height);
    };
    throw Error("The background '" + filter.settings.background_file + "' was recorded with " +
                text(filter.background->nearest.size) + " depth pixels, the camera has " +
                text(depth) + "; record it anew with theatron background record.");
}

void tell_missing_gpu(const filter::ChainSettings& settings) {
    static std::once_flag told;
    if (settings.device == filter::Device::processor || settings.off())
        return;
    std::call_once(told, [] {
        if (const std::string& why = filter::missing_gpu(); !why.empty())
            log::warning("filter", filter::on_processor(why));
    });
}

LoadedFilter FilterSource::load() {
    filter::ParsedChain parsed;
    fs::path folder;
    if (is_file(text_)) {
        file_ = text_;
        folder = file_.parent_path();
        std::error_code ignored;
        written_ = fs::last_write_time(file_, ignored);
        const Bytes bytes = files::read_file(file_, max_settings_bytes);
        parsed =
            filter::parse_chain_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        if (!parsed.problem.empty())
            throw Error("'" + text_ + "': " + parsed.problem);
    } else {
        parsed = filter::parse_chain(text_);
        if (!parsed.problem.empty())
            throw Error(parsed.problem);
    }
    LoadedFilter loaded{std::move(parsed.settings), nullptr};
    if (!loaded.settings.needs_background())
        return loaded;
    if (loaded.settings.background_file.empty())
        throw Error(
            "The filter 'background' needs a recorded background: write "
            "background:file=empty.background, and make one with theatron background record.");
    // A file beside the settings is meant from there.
    const fs::path name = folder / loaded.settings.background_file;
    const auto background = filter::decode_background(files::read_file(name, max_background_bytes));
    if (!background)
        throw Error("'" + name.string() +
                    "' is no recorded background; make one with theatron background record.");
    loaded.background = std::make_shared<const filter::Background>(*background);
    return loaded;
}

std::optional<LoadedFilter> FilterSource::changed() {
    if (file_.empty())
        return std::nullopt;
    std::error_code problem;
    const auto written = fs::last_write_time(file_, problem);
    if (problem || written == written_)
        return std::nullopt;
    return load();
}

std::vector<FilterSource> filter_sources(const std::vector<std::string>& arguments,
                                         const std::vector<std::string>& cameras,
                                         const std::string& usual) {
    std::string all = usual;
    std::vector<std::optional<std::string>> own(cameras.size());
    for (const std::string& argument : arguments) {
        const auto equals = argument.find('=');
        const std::string name = argument.substr(0, equals);
        const std::size_t camera =
            equals == std::string::npos ? cameras.size() : find_camera(name, cameras);
        if (camera < cameras.size())
            own[camera] = argument.substr(equals + 1);
        else if (equals != std::string::npos && is_number(name))
            throw Error("There is no camera " + name + " for --filter " + argument + ".");
        else
            all = argument;
    }
    std::vector<FilterSource> sources;
    for (const auto& what : own)
        sources.emplace_back(what.value_or(all));
    return sources;
}

}  // namespace theatron::host
