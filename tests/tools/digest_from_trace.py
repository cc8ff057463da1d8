#!/usr/bin/env python3
"""Recomputes the digest of a run from its trace, for a graph of plain numbers, by the definition alone.

usage: digest_from_trace.py JAROL GRAPH
"""
import csv
import json
import struct
import subprocess
import sys
import tempfile

MASK = (1 << 64) - 1


def fold(a, b):
    product = a * b
    return (product & MASK) ^ (product >> 64)


def splitmix64(count):
    state, keys = 0, []
    for _ in range(count):
        state = (state + 0x9E3779B97F4A7C15) & MASK
        z = state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        keys.append(z ^ (z >> 31))
    return keys


def xxh64(data):
    """XXH64 with seed 0, after its specification."""
    p1, p2, p3 = 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9
    p4, p5 = 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5

    def rotate(x, bits):
        return ((x << bits) | (x >> (64 - bits))) & MASK

    def round_of(lane, word):
        return (rotate((lane + word * p2) & MASK, 31) * p1) & MASK

    at = 0
    if len(data) >= 32:
        lanes = [(p1 + p2) & MASK, p2, 0, (-p1) & MASK]
        while at + 32 <= len(data):
            words = struct.unpack_from("<4Q", data, at)
            lanes = [round_of(lane, word) for lane, word in zip(lanes, words)]
            at += 32
        h = sum(rotate(lane, bits) for lane, bits in zip(lanes, (1, 7, 12, 18))) & MASK
        for lane in lanes:
            h = ((h ^ round_of(0, lane)) * p1 + p4) & MASK
    else:
        h = p5
    h = (h + len(data)) & MASK
    while at + 8 <= len(data):
        h = (rotate(h ^ round_of(0, struct.unpack_from("<Q", data, at)[0]), 27) * p1 + p4) & MASK
        at += 8
    if at + 4 <= len(data):
        h = (rotate(h ^ (struct.unpack_from("<I", data, at)[0] * p1 & MASK), 23) * p2 + p3) & MASK
        at += 4
    for byte in data[at:]:
        h = (rotate(h ^ (byte * p5 & MASK), 11) * p1) & MASK
    h = ((h ^ (h >> 33)) * p2) & MASK
    h = ((h ^ (h >> 29)) * p3) & MASK
    return h ^ (h >> 32)


def nanoseconds(text):
    whole, _, fraction = text.partition(".")
    return int(whole) * 10**9 + int(fraction.ljust(9, "0") or 0)


def digest_of(trace):
    k = splitmix64(6)
    total = 0
    with open(trace, newline="") as file:
        rows = csv.reader(file)
        names = next(rows)[1:]
        hashes = [xxh64(name.encode()) for name in names]
        for row in rows:
            instant = fold(nanoseconds(row[0]) ^ k[2], k[3])
            for name, cell in zip(hashes, row[1:]):
                if cell:
                    word = struct.unpack("<Q", struct.pack("<d", float(cell)))[0]
                    total += fold(((name + instant + fold(word ^ k[4], k[5])) & MASK) ^ k[0], k[1])
    return total & MASK


def main():
    jarol, graph = sys.argv[1:]
    assert xxh64(b"") == 0xEF46DB3751D8E999
    with tempfile.TemporaryDirectory() as folder:
        trace = folder + "/trace.csv"
        run = subprocess.run([jarol, "run", graph, "--for", "7.3s", "--trace", trace, "--json"], check=True,
                             capture_output=True, text=True)
        reported = json.loads(run.stdout)["digest"]
        computed = f"0x{digest_of(trace):016x}"
    print(f"reported by the run {reported}, computed from its trace {computed}")
    return 0 if reported == computed else 1


if __name__ == "__main__":
    sys.exit(main())
