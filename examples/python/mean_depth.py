# SPDX-License-Identifier: Apache-2.0
# Prints the mean depth of each second of a recording, in millimetres: mean_depth.py RECORDING
import collections, sys, numpy, theatron
means, frames = collections.defaultdict(list), theatron.Recording(sys.argv[1]).frames()
for frame in frames:
    metres = frame.depth_m()
    means[int(frame.seconds)].append(metres[metres > 0].mean() if metres.any() else numpy.nan)
for second, values in sorted(means.items()):
    print(second, round(1000 * float(numpy.nanmean(values)), 3))
sys.exit(f"left out: {frames.losses}" if frames.losses else 0)
