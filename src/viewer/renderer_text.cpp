// SPDX-License-Identifier: Apache-2.0
#include "viewer/renderer_text.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "pace/drawing_pace.h"
#include "phrases/phrase.h"
#include "render/cloud_set.h"

namespace theatron::viewer {
namespace {

std::string listed(const std::vector<std::string>& names, const char* between) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : between) + name;
    return text;
}

bool is_choice(const std::string& name) {
    const auto choices = renderer_choices();
    return std::find(choices.begin(), choices.end(), name) != choices.end();
}

}  // namespace

std::vector<std::string> renderer_choices() {
    std::vector<std::string> choices = render::renderer_names();
    choices.push_back(automatic);
    return choices;
}

void check_renderer_choice(const std::string& name) {
    if (!is_choice(name) && name != render::yardstick_renderer)
        throw Error(say(Phrase::no_renderer, name, listed(renderer_choices(), ", ")));
}

std::string renderer_for(const std::string& choice, std::size_t cameras) {
    if (choice != automatic)
        return choice;
    return pace::automatic_ways(cameras, 1).front().renderer;
}

std::string follow_host(session::RendererChoice& choice, const wire::SetRenderer& word) {
    try {
        if (!word.renderer.empty() && word.renderer != session::own_renderer)
            check_renderer_choice(word.renderer);
    } catch (const Error& e) {
        return say(Phrase::host_wants_unknown, e.what());
    }
    choice.follow(word);
    return {};
}

RendererText parse_renderer(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;)
        words.push_back(word);

    RendererText result;
    result.word.locked = !words.empty() && words.back() == "lock";
    if (result.word.locked)
        words.pop_back();
    const bool free = !result.word.locked && !words.empty() && words.back() == "free";
    if (words.empty() || (!free && !is_choice(words.back())))
        throw Error("Say 'renderer [WHO] NAME [lock]' or 'renderer [WHO] free': NAME is " +
                    listed(renderer_choices(), ", ") +
                    ", WHO a participant's number or name, or all.");
    if (!free)
        result.word.renderer = words.back();
    words.pop_back();
    result.who = listed(words, " ");
    if (result.who == "all")
        result.who.clear();
    return result;
}

}  // namespace theatron::viewer
