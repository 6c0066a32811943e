"""Kills the host of a room again and again, or has the room moved, and tells what its players saw.

Usage: failover.py [--rounds N] [--bots N] [--hosts N] [--silence MS] [--replicas N] [--by KILL|TERM|MOVE]

Each round: the owner is killed while bots steer; another host goes on. Told: from the kill to the first frame of the
new host, to the last bot that is back, whether each is back in its own louse, whether a tick was lost that the log had
acknowledged. At the end the joined log is proven."""

import argparse
import asyncio
import signal
import statistics
import sys
import time

import stage
import witness


async def wait_until(condition, patience=stage.PATIENCE, what=""):
    end = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < end, what
        await asyncio.sleep(0.005)


async def rounds(nats, hosts, player, options):
    names = list(hosts)
    owner = names[0]
    lice = [stage.Bot(f"bot {k}", [host.address for host in hosts.values()]) for k in range(options.bots)]
    tasks = [asyncio.ensure_future(bot.run()) for bot in lice]
    outages, returns, gaps, lost, strangers, handovers = [], [], [], 0, 0, []
    try:
        await wait_until(lambda: all(len(bot.welcomes) >= 1 for bot in lice), what="not all bots came")
        await asyncio.sleep(3)
        for number in range(1, options.rounds + 1):
            louse = {bot.name: bot.welcomes[-1][1]["id"] for bot in lice}
            welcomes = {bot.name: len(bot.welcomes) for bot in lice}
            acked = nats.tick()
            owned = {name: hosts[name].log().count("cluster_owns") for name in names if name != owner}
            killed = time.monotonic()
            if options.by == "MOVE":
                losses = sum(len(bot.losses) for bot in lice)
                moving = asyncio.ensure_future(asyncio.to_thread(nats.command, "move"))
                await wait_until(lambda: sum(len(bot.losses) for bot in lice) > losses, what="nothing moves")
                killed = max(bot.losses[-1] for bot in lice if bot.losses)
            else:
                hosts[owner].signal(signal.SIGKILL if options.by == "KILL" else signal.SIGTERM)
            await wait_until(lambda: any(len(bot.welcomes) > welcomes[bot.name] and bot.newest[0] > killed and
                                         bot.newest[1] >= bot.welcomes[-1][1]["tick"] for bot in lice),
                             what=f"round {number}: nobody sees a tick again:\n" + "\n".join(hosts[name].log() for name in owned))
            outages.append(time.monotonic() - killed)
            other, = (name for name, times in owned.items() if hosts[name].log().count("cluster_owns") > times)
            await wait_until(lambda: all(len(bot.welcomes) > welcomes[bot.name] for bot in lice),
                             what=f"round {number}: not all came back")
            returns.append(max(bot.welcomes[-1][0] for bot in lice) - killed)
            await asyncio.sleep(0.5)
            gaps.append(player.longest_gap(killed))
            first = min(bot.welcomes[-1][1]["tick"] for bot in lice)
            went_on = hosts[other].went_on_at()
            lost += went_on < acked
            handovers.append(went_on - acked)
            strangers += sum(not bot.welcomes[-1][1]["resumed"] or bot.welcomes[-1][1]["id"] != louse[bot.name] for bot in lice)
            assert first >= went_on, (first, went_on)
            if options.by == "MOVE":
                code, said = await moving
                assert code == 0, said
            else:
                hosts[owner].process.wait(stage.PATIENCE)
                hosts[owner].process.stdout.close()
                hosts[owner] = stage.Host(nats, owner, *stage_arguments(options))
                for bot in lice:
                    bot.addresses = [host.address for host in hosts.values()]
                player.use(bot.addresses)
                hosts[owner].wait_for("cluster_follows")
            owner = other
            await asyncio.sleep(options.pause)
    finally:
        for bot in lice:
            bot.stopped = True
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    return outages, returns, gaps, lost, strangers, lice


def stage_arguments(options):
    return ["--join-per-s-address", "100000", "--join-per-s-room", "100000", "--per-address", "10000"]


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--bots", type=int, default=20)
    parser.add_argument("--hosts", type=int, default=2)
    parser.add_argument("--silence", type=int, default=250)
    parser.add_argument("--replicas", type=int, default=1)
    parser.add_argument("--pause", type=float, default=2.0)
    parser.add_argument("--by", choices=["KILL", "TERM", "MOVE"], default="KILL")
    options = parser.parse_args()
    stage.skip_where_missing()
    with stage.Nats(options.replicas, silence_ms=options.silence) as nats:
        first = stage.Host(nats, "a", *stage_arguments(options))
        first.wait_for("cluster_owns")
        hosts = {"a": first}
        for name in "bcdefgh"[:options.hosts - 1]:
            hosts[name] = stage.Host(nats, name, *stage_arguments(options))
            hosts[name].wait_for("cluster_follows")
        try:
            with witness.Witness([host.address for host in hosts.values()]) as player:
                outages, returns, gaps, lost, strangers, lice = stage.play(rounds(nats, hosts, player, options))
        finally:
            logs = {name: host.log() for name, host in hosts.items()}
            for host in hosts.values():
                host.end()
        print(f"{options.rounds} times {options.by}, {options.bots} bots, {options.hosts} hosts, silence {options.silence} ms, R{options.replicas}:")
        for what, values in (("to the next tick that one of the bots sees", outages), ("longest pause between two frames of a player by himself", gaps)):
            milliseconds = [1000 * value for value in values]
            print(f"  {what} [ms]: median {statistics.median(milliseconds):.0f}, "
                  f"p95 {percentile(milliseconds, 0.95):.0f}, all {' '.join(f'{value:.0f}' for value in sorted(milliseconds))}")
        print(f"  to the last bot that is back [ms]: at most {1000 * max(returns):.0f}")
        told = {bye["code"] for bot in lice for bye in bot.byes + bot.turned_away} - {"moved"}
        print(f"  acknowledged ticks lost: {lost}; bots that are not back in their lice: {strangers}")
        code, said, proofs = nats.joined()
        print("  the joined log:", said.strip().splitlines()[-1])
        for name, (verified, text) in proofs.items():
            print(f"  {name}: {text.strip()}")
        if told:
            print(f"  bots were told {', '.join(sorted(told))} in place of moved")
        good = lost == 0 and strangers == 0 and not told and code == 0 and all(verified == 0 for verified, _ in proofs.values())
        if not good:
            print("\n".join(f"--- {name}\n{log}" for name, log in logs.items()))
        sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
