import argparse, time
from collections import Counter
from kinsym.robot import gallery
from tests import arms
from tests.sabotage.run import *

p = argparse.ArgumentParser()
p.add_argument("robots", nargs="*")
p.add_argument("--sample", type=int, default=20)
p.add_argument("--seed", type=int, default=1)
p.add_argument("--language", action="append")
o = p.parse_args()
for r in o.robots or gallery():
    t = time.time()
    s = Sabotage(arms.derivation(r))
    print(r, "ready", time.time() - t)
    for l in o.language or LANGUAGES:
        t = time.time()
        c = Counter()
        for m in s.sample(l, o.sample, o.seed):
            x = s.try_out(m)
            c[x.outcome] += 1
            if x.outcome != CAUGHT:
                print("   ", x.outcome, "|", x.reason, "|", m, flush=True)
        print(r, l, dict(c), time.time() - t, flush=True)
