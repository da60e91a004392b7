// SPDX-License-Identifier: Apache-2.0
#include "face/training.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "face/synthetic_faces.h"

namespace theatron::face {
namespace {

struct Example {
    Features features;
    Emotion label;
    ChannelMask present;
};

constexpr float calibration_s = 2;
// The time before it in a take is the beginning of an expression.
constexpr float settled_s = 0.8F;
constexpr std::size_t batch_size = 32;

std::size_t until(const Take& take, float seconds) {
    std::size_t count = 0;
    while (count < take.samples.size() && take.samples[count].time_s <= seconds)
        ++count;
    return count;
}

// The rest of a person; zeros where no take is neutral.
Channels rest_of(const Recording& recording, int person) {
    for (const Take& take : recording.takes)
        if (take.person == person && take.label == Emotion::neutral && !take.samples.empty())
            return mean_of(
                std::span(take.samples).first(until(take, take.samples[0].time_s + calibration_s)));
    return {};
}

// Windows of a take, one every `step_s`.
void add_examples(const Take& take, const Channels& rest, float step_s,
                  std::vector<Example>& examples) {
    if (take.samples.empty())
        return;
    const float begin = take.samples[0].time_s;
    for (float end = begin + std::max(settled_s, window_s);
         end <= take.samples.back().time_s + 1e-3F; end += step_s) {
        const auto samples = std::span(take.samples).first(until(take, end));
        examples.push_back({features_of(samples, rest), take.label, take.present});
    }
}

std::vector<Example> examples_of(const Recording& recording, float step_s, std::size_t without) {
    std::vector<Example> examples;
    int person = -1;
    Channels rest{};
    for (std::size_t i = 0; i < recording.takes.size(); ++i) {
        const Take& take = recording.takes[i];
        if (take.person != person) {
            person = take.person;
            rest = rest_of(recording, person);
        }
        if (i != without)
            add_examples(take, rest, step_s, examples);
    }
    return examples;
}
constexpr std::size_t none = std::size_t(-1);

ChannelMask with_missing(ChannelMask mask, double share, Random& random) {
    for (std::size_t c = 0; c < channel_count; ++c)
        if (random.chance(share))
            mask.reset(c);
    return mask;
}

// Gradients and moments of Adam (Kingma and Ba, 2015) for one array of weights.
template <std::size_t n>
struct Adam {
    std::array<float, n> gradient{}, first{}, second{};

    void step(std::array<float, n>& weights, float rate, float correct_first, float correct_second,
              float decay) {
        for (std::size_t i = 0; i < n; ++i) {
            const float g = gradient[i];
            first[i] += 0.1F * (g - first[i]);
            second[i] += 0.001F * (g * g - second[i]);
            weights[i] -=
                rate * (first[i] / correct_first / (std::sqrt(second[i] / correct_second) + 1e-8F) +
                        decay * weights[i]);
            gradient[i] = 0;
        }
    }
};

// Cross-entropy with a little of every label in each (label smoothing), so that certainty means
// something.
class Trainer {
public:
    explicit Trainer(Network& network)
        : network_(network), into_hidden_(feature_count), into_output_(emotion_count) {}

    void epoch(const std::vector<Example>& examples, float rate, Random& random) {
        std::vector<std::size_t> order(examples.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        for (std::size_t i = order.size(); i > 1; --i)
            std::swap(order[i - 1], order[random.below(i)]);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const Example& example = examples[order[i]];
            // Half of the windows lack channels, as a tracker does that loses sight of a part.
            const ChannelMask present =
                random.chance(0.5) ? with_missing(example.present, random.between(0, 0.35), random)
                                   : example.present;
            learn(example, present);
            if ((i + 1) % batch_size == 0 || i + 1 == order.size())
                step(rate);
        }
    }

private:
    void learn(const Example& example, const ChannelMask& present) {
        const ChannelMask usable = network_.mask & present;
        for (std::size_t i = 0; i < feature_count; ++i)
            scaled_[i] =
                usable[i % channel_count]
                    ? std::clamp((example.features[i] - network_.mean[i]) * network_.scale[i], -6.F,
                                 6.F)
                    : 0.F;
        Emotions out = network_.output_bias;
        std::array<float, hidden_count> active{};
        std::array<float, hidden_count> sums = network_.hidden_bias;
        for (std::size_t i = 0; i < feature_count; ++i)
            for (std::size_t h = 0; h < hidden_count; ++h)
                sums[h] += network_.into_hidden[i][h] * scaled_[i];
        for (std::size_t h = 0; h < hidden_count; ++h) {
            active[h] = std::tanh(sums[h]);
            for (std::size_t o = 0; o < emotion_count; ++o)
                out[o] += network_.into_output[o][h] * active[h];
        }
        const float top = *std::max_element(out.begin(), out.end());
        float total = 0;
        for (float& value : out)
            total += value = std::exp(value - top);
        std::array<float, hidden_count> back{};
        for (std::size_t o = 0; o < emotion_count; ++o) {
            constexpr float smoothing = 0.05F;
            const float goal = smoothing / float(emotion_count) +
                               (Emotion(o) == example.label ? 1 - smoothing : 0.F);
            const float error = (out[o] / total - goal) / float(batch_size);
            output_bias_.gradient[o] += error;
            for (std::size_t h = 0; h < hidden_count; ++h) {
                into_output_[o].gradient[h] += error * active[h];
                back[h] += error * network_.into_output[o][h];
            }
        }
        for (std::size_t h = 0; h < hidden_count; ++h) {
            back[h] *= 1 - active[h] * active[h];
            hidden_bias_.gradient[h] += back[h];
        }
        for (std::size_t i = 0; i < feature_count; ++i)
            for (std::size_t h = 0; h < hidden_count; ++h)
                into_hidden_[i].gradient[h] += back[h] * scaled_[i];
    }

    void step(float rate) {
        constexpr float decay = 1e-3F;
        first_power_ *= 0.9F;
        second_power_ *= 0.999F;
        const float first = 1 - first_power_, second = 1 - second_power_;
        for (std::size_t i = 0; i < feature_count; ++i)
            into_hidden_[i].step(network_.into_hidden[i], rate, first, second, decay);
        for (std::size_t o = 0; o < emotion_count; ++o)
            into_output_[o].step(network_.into_output[o], rate, first, second, decay);
        hidden_bias_.step(network_.hidden_bias, rate, first, second, 0);
        output_bias_.step(network_.output_bias, rate, first, second, 0);
    }

    Network& network_;
    Features scaled_{};
    std::vector<Adam<hidden_count>> into_hidden_;
    std::vector<Adam<hidden_count>> into_output_;
    Adam<hidden_count> hidden_bias_;
    Adam<emotion_count> output_bias_;
    float first_power_ = 1, second_power_ = 1;
};

void scale_by(Network& network, const std::vector<Example>& examples) {
    std::array<double, feature_count> sum{}, square{};
    for (const Example& example : examples)
        for (std::size_t i = 0; i < feature_count; ++i) {
            sum[i] += example.features[i];
            square[i] += double(example.features[i]) * example.features[i];
        }
    const double count = double(examples.size());
    for (std::size_t i = 0; i < feature_count; ++i) {
        const double mean = sum[i] / count;
        network.mean[i] = float(mean);
        network.scale[i] = float(1 / std::sqrt(std::max(square[i] / count - mean * mean, 1e-4)));
    }
}

Network trained_further(const Network& synthetic, const Recording& own, std::size_t without,
                        const TrainingParams& params) {
    std::vector<Example> examples = examples_of(own, 0.15F, without);
    const std::vector<Example> made =
        examples_of(synthetic_recording(synthetic.source, 12, params.seed + 77), 0.7F, none);
    examples.insert(examples.end(), made.begin(), made.end());
    Network network = synthetic;
    network.is_synthetic_only = false;
    network.own_takes = std::uint32_t(own.takes.size() - (without == none ? 0 : 1));
    Random random(params.seed);
    Trainer trainer(network);
    for (int epoch = 0; epoch < params.own_epochs; ++epoch)
        trainer.epoch(examples, 1e-3F, random);
    return network;
}

}  // namespace

int Confusion::total() const {
    int sum = 0;
    for (const auto& row : counts)
        for (const int count : row)
            sum += count;
    return sum;
}

double Confusion::accuracy() const {
    int right = 0;
    for (std::size_t i = 0; i < emotion_count; ++i)
        right += counts[i][i];
    return total() == 0 ? 0 : double(right) / total();
}

std::string to_text(const Confusion& confusion) {
    char field[64];
    std::string text = "asked \\ told";
    for (const std::string_view name : emotion_names) {
        std::snprintf(field, sizeof(field), " %9.*s", int(name.size()), name.data());
        text += field;
    }
    text += "    recall\n";
    for (std::size_t asked = 0; asked < emotion_count; ++asked) {
        std::snprintf(field, sizeof(field), "%-12.*s", int(emotion_names[asked].size()),
                      emotion_names[asked].data());
        text += field;
        int sum = 0;
        for (const int count : confusion.counts[asked]) {
            std::snprintf(field, sizeof(field), " %9d", count);
            text += field;
            sum += count;
        }
        std::snprintf(field, sizeof(field), "%10.2f\n",
                      sum == 0 ? 0.0 : double(confusion.counts[asked][asked]) / sum);
        text += field;
    }
    return text;
}

Network train_synthetic(Source source, const TrainingParams& params, const Progress& progress) {
    return *train_synthetic_until(
        source, params, [] { return false; }, progress);
}

std::optional<Network> train_synthetic_until(Source source, const TrainingParams& params,
                                             const Stops& stops, const Progress& progress) {
    const std::vector<Example> examples =
        examples_of(synthetic_recording(source, params.persons, params.seed), 0.7F, none);
    Network network;
    network.source = source;
    network.mask = table_of(source).mask;
    scale_by(network, examples);
    Random random(params.seed);
    for (auto& row : network.into_hidden)
        for (float& weight : row)
            weight = float(random.normal() / std::sqrt(double(feature_count)));
    for (auto& row : network.into_output)
        for (float& weight : row)
            weight = float(random.normal() / std::sqrt(double(hidden_count)));
    Trainer trainer(network);
    for (int epoch = 0; epoch < params.epochs; ++epoch) {
        const float left = 1 - float(epoch) / float(params.epochs);
        trainer.epoch(examples, 2e-3F * left, random);
        if (progress)
            progress(double(epoch + 1) / params.epochs);
        if (stops())
            return std::nullopt;
    }
    return network;
}

Network train_own(const Network& synthetic, const Recording& own, const TrainingParams& params) {
    return trained_further(synthetic, own, none, params);
}

Confusion leave_one_take_out(const Network& synthetic, const Recording& own,
                             const TrainingParams& params, const Progress& progress) {
    Confusion confusion;
    for (std::size_t i = 0; i < own.takes.size(); ++i) {
        const Take& take = own.takes[i];
        const auto same = std::count_if(own.takes.begin(), own.takes.end(), [&](const Take& other) {
            return other.label == take.label;
        });
        if (same >= 2) {
            const Network network = trained_further(synthetic, own, i, params);
            std::vector<Example> examples;
            add_examples(take, rest_of(own, take.person), 0.3F, examples);
            for (const Example& example : examples)
                confusion.add(example.label,
                              decide(evaluate(network, example.features, example.present)));
        }
        if (progress)
            progress(double(i + 1) / double(own.takes.size()));
    }
    return confusion;
}

Confusion confusion_of(const Network& network, const Recording& recording, double missing,
                       std::uint64_t seed) {
    Random random(seed);
    Confusion confusion;
    for (const Example& example : examples_of(recording, 0.5F, none))
        confusion.add(example.label,
                      decide(evaluate(network, example.features,
                                      with_missing(example.present, missing, random))));
    return confusion;
}

std::string problem_of_own(const Recording& own) {
    std::array<bool, emotion_count> has{};
    for (const Take& take : own.takes) {
        if (!fills_window(take.samples) ||
            take.samples.back().time_s - take.samples.front().time_s < settled_s)
            return "a take of " + std::string(to_text(take.label)) +
                   " is shorter than 0.8 s; record takes of 3 to 5 s";
        if (take.present.none())
            return "a take of " + std::string(to_text(take.label)) +
                   " has no channel that is there in every row";
        has[std::size_t(take.label)] = true;
    }
    for (std::size_t i = 0; i < emotion_count; ++i)
        if (!has[i])
            return "there is no take of " + std::string(emotion_names[i]) +
                   "; a recording needs all six emotions";
    return "";
}

}  // namespace theatron::face
