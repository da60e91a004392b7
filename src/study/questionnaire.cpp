// SPDX-License-Identifier: Apache-2.0
#include "study/questionnaire.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdint>

#include "base/outside_text.h"
#include "base/trimmed.h"

namespace theatron::study {
namespace {

constexpr std::size_t shown_of_value = 60;

std::string shown(std::string_view text) {
    return "'" + clean_text(text, shown_of_value) + "'";
}

std::optional<int> whole(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                    : std::nullopt;
}

// "9.54" or "100/12", above 0.
std::optional<double> factor_of(std::string_view text) {
    const auto number = [](std::string_view part) -> std::optional<double> {
        // std::from_chars of em++'s library has no floating point.
        double value = 0, place = 1;
        bool is_fraction = false;
        if (part.empty() || part.size() > 12)
            return std::nullopt;
        for (const char c : part) {
            if (c == '.' && !is_fraction)
                is_fraction = true;
            else if (c < '0' || c > '9')
                return std::nullopt;
            else
                value = value * 10 + (c - '0'), place *= is_fraction ? 10 : 1;
        }
        return value / place;
    };
    const std::size_t slash = text.find('/');
    const auto above = number(trimmed(text.substr(0, slash)));
    const auto below = slash == text.npos ? 1.0 : number(trimmed(text.substr(slash + 1)));
    if (!above || !below || !(*above > 0) || !(*below > 0))
        return std::nullopt;
    return *above / *below;
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!(text = trimmed(text)).empty()) {
        const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return words;
}

template <class Part>
std::optional<std::size_t> place_of(const std::vector<Part>& parts, std::string_view id) {
    const auto found =
        std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.id == id; });
    return found == parts.end() ? std::nullopt : std::optional(std::size_t(found - parts.begin()));
}

class QuestionnaireReader {
public:
    explicit QuestionnaireReader(Questionnaires& known) : known_(known) {}

    // Empty: the line was taken.
    std::string take(const ConfigLine& line) {
        if (line.value.size() > max_text_bytes)
            return "the value is longer than " + std::to_string(max_text_bytes) + " bytes";
        if (clean_text(line.value, line.value.size()) != line.value)
            return "the value is no plain UTF-8 text";
        if (line.key == "questionnaire")
            return begin(line.value);
        if (!questionnaire_)
            return "a line 'questionnaire = NAME' must stand before it";
        if (line.key == "anchors")
            return take_anchors(line.value);
        if (line.key == "item")
            return only_texts_ ? choose_item(line.value) : add_item(line.value);
        if (line.key == "text")
            return take_text(line.value);
        if (only_texts_)
            return shown(questionnaire_->id) +
                   " is known already; a file gives it anchors, items and texts alone";
        if (line.key == "scale")
            return add_scale(line.value);
        if (item_)
            return take_of_item(line);
        if (scale_)
            return take_of_scale(line);
        return take_of_questionnaire(line);
    }

private:
    std::string begin(const std::string& id) {
        item_ = nullptr;
        scale_ = nullptr;
        questionnaire_ = nullptr;
        if (!is_id(id))
            return shown(id) + " is no name of letters, digits, '-' and '_'";
        for (Questionnaire& known : known_.all)
            if (known.id == id)
                questionnaire_ = &known;
        only_texts_ = questionnaire_;
        if (only_texts_)
            return "";
        if (known_.all.size() >= max_questionnaires)
            return "a study has at most " + std::to_string(max_questionnaires) + " questionnaires";
        questionnaire_ = &known_.all.emplace_back();
        questionnaire_->id = questionnaire_->title = id;
        usual_ = Item();
        return "";
    }

    std::string take_anchors(const std::string& value) {
        const auto parts = listed(value);
        if (parts.size() != 2)
            return shown(value) + " are not two words or phrases with a | between them";
        if (item_) {
            item_->left = parts[0];
            item_->right = parts[1];
        } else {
            usual_.left = parts[0];
            usual_.right = parts[1];
            if (only_texts_)
                for (Item& item : questionnaire_->items) {
                    item.left = parts[0];
                    item.right = parts[1];
                }
        }
        return "";
    }

    std::string choose_item(const std::string& id) {
        const auto place = place_of(questionnaire_->items, id);
        item_ = place ? &questionnaire_->items[*place] : nullptr;
        return place ? "" : shown(questionnaire_->id) + " has no item " + shown(id);
    }

    std::string add_item(const std::string& value) {
        item_ = nullptr;
        const auto words = words_of(value);
        if (!is_id(words[0]))
            return shown(words[0]) + " is no name of letters, digits, '-' and '_'";
        if (place_of(questionnaire_->items, words[0]))
            return "the item " + shown(words[0]) + " is there already";
        if (questionnaire_->items.size() >= max_items)
            return "a questionnaire has at most " + std::to_string(max_items) + " items";
        if (usual_.lowest >= usual_.highest || (usual_.highest - usual_.lowest) % usual_.step != 0)
            return "from " + std::to_string(usual_.lowest) + " to " +
                   std::to_string(usual_.highest) + " there are no points in steps of " +
                   std::to_string(usual_.step) + "; the lines lowest, highest and step say which";
        Item item = usual_;
        item.id = words[0];
        for (std::size_t i = 1; i < words.size(); ++i) {
            const auto scale = place_of(questionnaire_->scales, words[i]);
            if (!scale)
                return "there is no scale " + shown(words[i]) + " before this line";
            if (questionnaire_->scales[*scale].from == Scale::From::mean_of_scales)
                return "the scale " + shown(words[i]) + " is the mean of other scales";
            if (item.scales.size() >= max_scales)
                return "an item counts at most " + std::to_string(max_scales) + " times";
            item.scales.push_back(*scale);
        }
        item_ = &questionnaire_->items.emplace_back(std::move(item));
        return "";
    }

    std::string take_text(const std::string& value) {
        if (!item_)
            return "a line 'item = NAME' must stand before it";
        item_->text = value;
        return "";
    }

    std::string add_scale(const std::string& value) {
        item_ = nullptr;
        scale_ = nullptr;
        const auto parts = listed(value);
        if (!is_id(parts[0]) || parts.size() > 2)
            return shown(value) + " is not NAME or NAME | TITLE";
        if (place_of(questionnaire_->scales, parts[0]))
            return "the scale " + shown(parts[0]) + " is there already";
        if (questionnaire_->scales.size() >= max_scales)
            return "a questionnaire has at most " + std::to_string(max_scales) + " scales";
        scale_ = &questionnaire_->scales.emplace_back();
        scale_->id = parts[0];
        scale_->title = parts.back();
        return "";
    }

    std::string take_of_item(const ConfigLine& line) {
        if (line.key == "reversed")
            return take_yes(line.value, item_->reversed);
        if (line.key != "choices")
            return "no such line may stand below an item; there are text, anchors, reversed and "
                   "choices";
        const auto choices = listed(line.value);
        if (choices.size() < 2 || choices.size() > max_choices)
            return "there are 2 to " + std::to_string(max_choices) +
                   " choices with a | between them";
        if (!item_->scales.empty())
            return "an item with choices has no points, so it belongs to no scale";
        item_->choices = choices;
        item_->lowest = 1;
        item_->highest = int(choices.size());
        item_->step = 1;
        return "";
    }

    std::string take_of_scale(const ConfigLine& line) {
        if (line.key == "zero-based")
            return take_yes(line.value, scale_->zero_based);
        if (line.key == "factor") {
            const auto factor = factor_of(line.value);
            scale_->factor = factor.value_or(1);
            return factor ? "" : shown(line.value) + " is no number above 0 like 9.54 or 100/12";
        }
        if (line.key != "from")
            return "no such line may stand below a scale; there are from, factor and zero-based";
        const auto words = words_of(line.value);
        if (words.size() == 1 && (words[0] == "mean" || words[0] == "sum")) {
            scale_->from = words[0] == "sum" ? Scale::From::sum : Scale::From::mean;
            return "";
        }
        if (words.size() < 3 || words[0] != "mean" || words[1] != "of")
            return shown(line.value) + " is neither mean, sum nor 'mean of SCALE...'";
        scale_->parts.clear();
        for (std::size_t i = 2; i < words.size(); ++i) {
            const auto part = place_of(questionnaire_->scales, words[i]);
            if (!part || *part + 1 == questionnaire_->scales.size())
                return "there is no scale " + shown(words[i]) + " before this one";
            scale_->parts.push_back(*part);
        }
        scale_->from = Scale::From::mean_of_scales;
        return "";
    }

    std::string take_of_questionnaire(const ConfigLine& line) {
        if (line.key == "title")
            questionnaire_->title = line.value;
        else if (line.key == "source")
            questionnaire_->source = line.value;
        else if (line.key == "texts-at")
            questionnaire_->texts_at = line.value;
        else if (line.key == "lowest" || line.key == "highest" || line.key == "step")
            return take_points(line);
        else
            return "there is no such line; a questionnaire has title, source, texts-at, lowest, "
                   "highest, step, anchors, scale and item";
        return "";
    }

    std::string take_points(const ConfigLine& line) {
        const auto value = whole(line.value);
        if (!value || *value < (line.key == "step" ? 1 : -max_points) || *value > max_points)
            return shown(line.value) + " is no whole number from " +
                   (line.key == "step" ? "1" : std::to_string(-max_points)) + " to " +
                   std::to_string(max_points);
        (line.key == "lowest" ? usual_.lowest
         : line.key == "step" ? usual_.step
                              : usual_.highest) = *value;
        return "";
    }

    static std::string take_yes(const std::string& value, bool& flag) {
        flag = value == "yes";
        return flag || value == "no" ? "" : shown(value) + " is neither yes nor no";
    }

    Questionnaires& known_;
    Questionnaire* questionnaire_ = nullptr;
    Scale* scale_ = nullptr;
    Item* item_ = nullptr;
    Item usual_;  // points and anchors of the items that follow
    bool only_texts_ = false;
};

// Mistakes of questionnaires as wholes.
void check_whole(const Questionnaires& known, std::vector<ConfigMistake>& mistakes) {
    for (const Questionnaire& one : known.all) {
        if (one.items.empty())
            mistakes.push_back({0, "", "the questionnaire " + shown(one.id) + " has no item"});
        for (std::size_t s = 0; s < one.scales.size(); ++s) {
            bool used = one.scales[s].from == Scale::From::mean_of_scales;
            for (const Item& item : one.items)
                used |= std::count(item.scales.begin(), item.scales.end(), s) > 0;
            if (!used)
                mistakes.push_back({0, "",
                                    "the scale " + shown(one.scales[s].id) + " of " +
                                        shown(one.id) + " has no item"});
        }
    }
}

// The item's point as it counts in a scale.
double counted(const Item& item, double point, bool zero_based) {
    const double turned = item.reversed ? item.lowest + item.highest - point : point;
    return zero_based ? turned - item.lowest : turned;
}

// The value of a scale, where `point_of` gives the points of items and `scale_of` other scales.
template <class PointOf, class ScaleOf>
std::optional<double> value_of(const Questionnaire& questionnaire, std::size_t place,
                               const PointOf& point_of, const ScaleOf& scale_of) {
    const Scale& scale = questionnaire.scales[place];
    double sum = 0;
    int count = 0;
    const auto add = [&](std::optional<double> value) {
        sum += value.value_or(0);
        ++count;
        return value.has_value();
    };
    if (scale.from == Scale::From::mean_of_scales) {
        for (const std::size_t part : scale.parts)
            if (!add(scale_of(part)))
                return std::nullopt;
    } else {
        for (const Item& item : questionnaire.items)
            for (const std::size_t in : item.scales)
                if (in == place && !add(point_of(item, scale.zero_based)))
                    return std::nullopt;
    }
    if (count == 0)
        return std::nullopt;
    return scale.factor * (scale.from == Scale::From::sum ? sum : sum / count);
}

}  // namespace

bool Questionnaire::has_texts() const {
    return items_without_text().empty();
}

std::vector<std::string> Questionnaire::items_without_text() const {
    std::vector<std::string> missing;
    for (const Item& item : items)
        if (item.text.empty())
            missing.push_back(item.id);
    return missing;
}

const Questionnaire* Questionnaires::find(std::string_view id) const {
    const auto place = place_of(all, id);
    return place ? &all[*place] : nullptr;
}

std::vector<ConfigMistake> add_questionnaires(std::string_view text, Questionnaires& known) {
    ConfigText config = parse_config(text);
    Questionnaires draft = known;
    QuestionnaireReader reader(draft);
    for (const ConfigLine& line : config.lines)
        if (std::string why = reader.take(line); !why.empty())
            config.mistakes.push_back({line.line, line.key, std::move(why)});
    if (config.mistakes.empty())
        check_whole(draft, config.mistakes);
    if (config.mistakes.empty())
        known = std::move(draft);
    std::stable_sort(config.mistakes.begin(), config.mistakes.end(),
                     [](const auto& a, const auto& b) { return a.line < b.line; });
    return config.mistakes;
}

bool is_id(std::string_view text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    constexpr std::size_t longest_id = 32;
    return !text.empty() && text.size() <= longest_id && is_letter(text.front()) &&
           std::all_of(text.begin(), text.end(), [&](char c) {
               return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_';
           });
}

std::vector<std::string> listed(std::string_view text) {
    std::vector<std::string> parts;
    while (true) {
        const std::size_t bar = text.find('|');
        parts.emplace_back(trimmed(text.substr(0, bar)));
        if (bar == text.npos)
            break;
        text.remove_prefix(bar + 1);
    }
    // One that is empty is none.
    if (std::any_of(parts.begin(), parts.end(), [](const std::string& p) { return p.empty(); }))
        return {""};
    return parts;
}

std::vector<std::optional<double>> scores(const Questionnaire& questionnaire,
                                          const Replies& replies) {
    std::vector<std::optional<double>> values;
    const auto point_of = [&](const Item& item, bool zero_based) -> std::optional<double> {
        const auto found = replies.find(item.id);
        if (found == replies.end())
            return std::nullopt;
        assert(found->second >= item.lowest && found->second <= item.highest);
        return counted(item, found->second, zero_based);
    };
    for (std::size_t s = 0; s < questionnaire.scales.size(); ++s)
        values.push_back(
            value_of(questionnaire, s, point_of, [&](std::size_t other) { return values[other]; }));
    return values;
}

std::pair<double, double> bounds(const Questionnaire& questionnaire, std::size_t scale) {
    // A scale rises with the counted points of its items.
    const auto value = [&](const auto& self, std::size_t place, bool high) -> double {
        return value_of(
                   questionnaire, place,
                   [&](const Item& item, bool zero_based) {
                       return std::optional(counted(
                           item, high != item.reversed ? item.highest : item.lowest, zero_based));
                   },
                   [&](std::size_t other) { return std::optional(self(self, other, high)); })
            .value_or(0);
    };
    return {value(value, scale, false), value(value, scale, true)};
}

}  // namespace theatron::study
