# SPDX-License-Identifier: BSD-3-Clause
"""What a trace must be for Perfetto to open it without a warning, and for a reader to rely on it."""

import collections
import json
import re


def nanoseconds(microseconds):
    return round(1000 * microseconds)


def as_perfetto_reads(microseconds):
    """To a double and cut off: a nanosecond may be lost."""
    return int(microseconds * 1000.0)


class Slice:
    def __init__(self, event):
        self.thread = (event["pid"], event["tid"])
        self.name = event["name"]
        self.begin = nanoseconds(event["ts"])
        self.end = self.begin + nanoseconds(event["dur"])
        self.args = event.get("args", {})
        self.read_begin = as_perfetto_reads(event["ts"])
        self.read_end = self.read_begin + as_perfetto_reads(event["dur"])


class Trace:
    """The events of a trace, taken in as Perfetto does it: each thread has a stack of open slices, and the end of a
    flow belongs to the innermost. Whatever breaks a rule raises AssertionError."""

    def __init__(self, text):
        document = json.loads(text)
        assert list(document) == ["traceEvents"], list(document)
        events = document["traceEvents"]
        assert len(re.findall(r'"ts":\d+\.\d{3}[,}]', text)) == sum("ts" in event for event in events)
        assert len(re.findall(r'"dur":\d+\.\d{3}[,}]', text)) == sum("dur" in event for event in events)
        self.names = {}
        self.thread_names = {}
        self.sort_indices = {}
        self.slices = []
        self.counters = collections.defaultdict(list)
        self.starts = {}
        self.finishes = {}
        self._stacks = collections.defaultdict(list)
        last = 0
        for event in events:
            assert isinstance(event["pid"], int) and isinstance(event["tid"], int), event
            if "ts" in event:
                assert event["ts"] >= last, event
                last = event["ts"]
            {"M": self._metadata, "X": self._slice, "s": self._flow_end, "f": self._flow_end,
             "C": self._counter}[event["ph"]](event)
        assert self.starts.keys() == self.finishes.keys()
        assert len({each for _, _, each in self.starts}) == len(self.starts), "two flows share a number"
        for key, start in self.starts.items():
            assert start[1] <= self.finishes[key][1], key
        threads = {each.thread for each in self.slices}
        assert threads <= self.thread_names.keys()
        assert len({tid for _, tid in self.thread_names}) == len(self.thread_names), "a thread's number is not its own"

    def arrows(self, name):
        """The slices that arrows of this name lead from and to."""
        return [(self.starts[key][0], self.finishes[key][0]) for key in self.starts if key[1] == name]

    def _metadata(self, event):
        if event["name"] == "process_name":
            assert event["pid"] not in self.names
            self.names[event["pid"]] = event["args"]["name"]
        elif event["name"] == "process_sort_index":
            self.sort_indices[event["pid"]] = event["args"]["sort_index"]
        elif event["name"] == "thread_name":
            self.thread_names[event["pid"], event["tid"]] = event["args"]["name"]

    def _slice(self, event):
        new = Slice(event)
        assert new.begin < new.end, event
        self._close(new.thread, new.begin)
        stack = self._stacks[new.thread]
        if stack:
            assert new.end <= stack[-1].end, (event, "overlaps", stack[-1].name)
            assert new.read_end <= stack[-1].read_end, (event, "overlaps when read", stack[-1].name)
        stack.append(new)
        self.slices.append(new)

    def _close(self, thread, now):
        stack = self._stacks[thread]
        while stack and stack[-1].end <= now:
            stack.pop()

    def _flow_end(self, event):
        assert event["bp"] == "e"
        thread = (event["pid"], event["tid"])
        now = nanoseconds(event["ts"])
        stack = self._stacks[thread]
        assert stack and stack[-1].begin <= now < stack[-1].end, (event, "lies in no slice")
        ends = self.starts if event["ph"] == "s" else self.finishes
        key = (event["cat"], event["name"], event["id"])
        assert key not in ends, (key, "is not unique")
        assert event["ph"] == "s" or key in self.starts, (key, "ends before it starts")
        ends[key] = (stack[-1], now)

    def _counter(self, event):
        for series, value in event["args"].items():
            self.counters[event["pid"], f"{event['name']} {series}"].append(value)
