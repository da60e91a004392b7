// SPDX-License-Identifier: Apache-2.0
#include "compare_costs.h"

#include <algorithm>
#include <ctime>

#include "base/statistics.h"

namespace theatron::bench {

double processor_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

void share_out(std::vector<std::vector<PictureCost>>& cameras,
               const std::vector<PictureCost>& moments,
               const std::vector<std::vector<PictureCost>>& alone) {
    for (std::size_t i = 0; i < moments.size(); ++i)
        for (double PictureCost::*time : {&PictureCost::sender_ms, &PictureCost::receiver_ms}) {
            double all = 0;
            for (const std::vector<PictureCost>& camera : alone)
                all += camera[i].*time;
            for (std::size_t c = 0; c < cameras.size(); ++c)
                cameras[c][i].*time = all > 0 ? moments[i].*time * (alone[c][i].*time / all)
                                              : moments[i].*time / double(cameras.size());
        }
}

void add_costs(CompareMethod& method, const std::vector<std::vector<PictureCost>>& cameras,
               const std::vector<CompareLink>& links) {
    const std::size_t pictures = cameras.front().size(), first = pictures > 1 ? 1 : 0;
    std::vector<SentMoment> moments(pictures);
    std::vector<double> sender, receiver, sender_of_all(pictures), receiver_of_all(pictures);
    double bytes = 0;
    for (const std::vector<PictureCost>& camera : cameras)
        for (std::size_t i = 0; i < pictures; ++i) {
            const PictureCost& cost = camera[i];
            SentMoment& moment = moments[i];
            moment.bytes += cost.bytes;
            moment.sender_ms = std::max(moment.sender_ms, cost.sender_ms);
            moment.receiver_ms = std::max(moment.receiver_ms, cost.receiver_ms);
            sender_of_all[i] += cost.sender_ms;
            receiver_of_all[i] += cost.receiver_ms;
            if (i < first)
                continue;
            bytes += double(cost.bytes);
            sender.push_back(cost.sender_ms);
            receiver.push_back(cost.receiver_ms);
        }
    method.cameras = int(cameras.size());
    method.mbit_per_camera = bytes / double(sender.size()) * 8 * compare_pictures_per_s / 1e6;
    method.sender_ms = median(sender);
    method.receiver_ms = median(receiver);
    for (std::vector<double>* times : {&sender_of_all, &receiver_of_all})
        times->erase(times->begin(), times->begin() + std::ptrdiff_t(first));
    method.sender_of_all_ms = median(sender_of_all);
    method.receiver_of_all_ms = median(receiver_of_all);
    for (const CompareLink& link : links)
        method.links.push_back(sent_over(link, moments, compare_pictures_per_s));
}

}  // namespace theatron::bench
