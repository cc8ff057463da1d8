"""The JSON Schema against another reader of it: it takes every graph that is shipped, and refuses every broken one that a
schema can see is broken. YAML is read as editors do, by the core schema of YAML 1.2.

usage: schema_test.py SCHEMA SPECS
"""
import json
import pathlib
import re
import sys

import jsonschema
import yaml

# What only a program that resolves names, reads files and does sums can see, each with the reason.
BEYOND_A_SCHEMA = {
    "what other parts of the graph are called": """
        campaign_unknown_path campaign_vary_no_value chain_not_connected chain_unknown_end channel_with_two_readers
        channel_with_two_writers
        communicator_named_as_a_task communicator_open communicator_unknown_distributer connection_dot_at_communicator
        connection_fed_twice connection_from_an_out connection_to_an_in connection_types connection_unknown_end
        connection_unknown_input connection_unknown_output connection_without_input connection_without_output
        cycle_without_let input_open safe_of_an_in safe_without_in safe_without_timeout
        timeout_of_an_out timeout_without_safe""",
    "sums and comparisons": """
        campaign_metrics_case campaign_seeds_all campaign_seeds_down core_beyond_platform deadline_later_than_derived
        deadline_later_than_let let_longer_than_period
        offset_not_below_period period_missing period_no_part_of_the_graph timeout_shorter_than_period
        duration_beyond_ten_years duration_part_of_a_nanosecond duration_too_large heap_too_large heap_too_small
        heaps_too_large_together heap_initial_values heap_of_nothing size_part_of_a_byte link_announces_nowhere
        link_announces_to_other_family link_listens_to_itself
        init_not_finite_in_its_unit""",
    "the language of conditions": """
        at_end_until_comparison at_end_until_metric at_end_until_names at_end_until_once at_end_until_true
        at_end_until_window expect_choices expect_names expect_within_negative vehicle_expect_true_value""",
    "other files": """
        link_file_missing link_key_missing plugins_no_file plugins_no_library script_cells script_empty
        script_first_column script_order script_time script_unknown_column script_value trim_file_is_none
        vehicle_file_key vehicle_grid vehicle_impossible vehicle_unknown""",
    "overrides": """
        profile_missing profile_path_has_an_empty_part profile_path_through_a_word profile_path_unknown
        profile_takes_away_what_is_not_there""",
    "how YAML is written": """
        integer_leading_zero init_leading_zero link_id_leading_zero""",
}


# What users write: the end of a graph, and what of it is wrong; empty: nothing.
WRITTEN = [
    ("tasks: {a: {type: HeadingControl, parameters: {kp: 0.5, rate_limit: 20deg/s}}}", ""),
    ("tasks: {a: {type: HeadingControl, parameters: {rate_limit: 20m}}}", "tasks/a/parameters/rate_limit"),
    ("tasks: {a: {type: HeadingControl, parameters: {gain: 1}}}", "tasks/a/parameters"),
    ("tasks: {a: {type: HeadingControl, init: {moment: {x: 1}}}}", "tasks/a/init/moment"),
    ("tasks: {a: {type: Mine, parameters: {anything: 1}}}", "tasks/a/type"),
    ("tasks: {a: {type: Mine, parameters: {anything: 1}}}\nplugins: [mine.so]", ""),
    ("tasks: {a: {type: Counter, perod: 1ms}}\nplugins: [mine.so]", "tasks/a"),
    ("distributers: {d: {type: LauvOperator, link: {type: script, file: x.csv}, parameters: {silence: 3 s}}}", ""),
    ("distributers: {d: {type: LauvOperator, link: {type: lockstep, peer: 7010}}}", "distributers/d/link/type"),
    ("distributers: {d: {type: LauvVehicle, link: {type: lockstep, peer: 7010}}}", ""),
    ("distributers: {d: {type: LauvVehicle, link: {type: udp, peer: '[::1]:7002', id: 0x00D1, silence: 500ms}}}", ""),
    ("distributers: {d: {type: LauvVehicle, link: {type: udp, peer: 7002, id: 0x100D1}}}", "distributers/d/link/id"),
    ("communicators: {c: {channel: d.setpoint, init: {depth: 3, turn: rate}}}", ""),
    ("communicators: {c: {channel: d.setpoint, init: {turn: left}}}", "communicators/c/init/turn"),
    ("communicators: {c: {channel: d.actuation, safe: {fins: [0, 0, 0, 0]}}}", ""),
    ("communicators: {c: {channel: d.actuation, safe: {fins: [0, 0, 0]}}}", "communicators/c/safe/fins"),
    ("tasks: {a: {type: Counter}}\nplatform: {policy: edf}", ""),
    ("tasks: {a: {type: Counter}}\nplatform: {policy: mine}", "platform/policy"),
    ("tasks: {a: {type: Counter}}\nplatform: {policy: mine}\nplugins: [mine.so]", ""),
    ("tasks: {a: {type: Counter}}\nplatform: {policy: [edf]}\nplugins: [mine.so]", "platform/policy"),
    ("tasks: {a: {type: Counter}}\ncampaign: {vary: {tasks.a.let: [20ms, null]}}", ""),
    ("tasks: {a: {type: Counter}}\ncampaign: {vary: {seed: [3, null]}}", "campaign/vary/seed"),
]


class Core(yaml.SafeLoader):
    """YAML 1.2, core schema; a key that is there twice is an error, as editors report it."""

    def construct_mapping(self, node, deep=False):
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        if len(set(keys)) < len(keys):
            raise yaml.YAMLError("a key is there twice")
        return super().construct_mapping(node, deep)


Core.yaml_implicit_resolvers = {}
for tag, expression, first in (
    ("null", r"^(null|Null|NULL|~|)$", list("nN~") + [""]),
    ("bool", r"^(true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    ("int", r"^([-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+)$", list("-+0123456789")),
    ("float", r"^([-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN))$",
     list("-+0123456789.")),
):
    Core.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(expression), first)
Core.add_constructor("tag:yaml.org,2002:int",
                     lambda loader, node: int(node.value, 0 if node.value[:2] in ("0x", "0o") else 10))


def flaw(validator, text):
    """The first thing that is wrong, or nothing."""
    try:
        found = yaml.load(text, Loader=Core)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        return "not read: " + str(error)
    for error in validator.iter_errors(found):
        return "/".join(map(str, error.absolute_path)) + ": " + error.message[:200]
    return ""


def main(schema_path, specs):
    schema = json.loads(pathlib.Path(schema_path).read_text(errors="surrogateescape"))
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    beyond = {name for names in BEYOND_A_SCHEMA.values() for name in names.split()}
    shipped = sorted(pathlib.Path(specs).glob("*.yaml"))
    broken = sorted(pathlib.Path(specs, "broken").glob("*.yaml"))
    wrong = []
    for path in shipped:
        if reason := flaw(validator, path.read_text(errors="surrogateescape")):
            wrong.append(f"{path} is refused: {reason}")
    for path in broken:
        seen = flaw(validator, path.read_text(errors="surrogateescape"))
        if not seen and path.stem not in beyond:
            wrong.append(f"{path} is taken; make the schema refuse it, or say here why none can")
        if seen and path.stem in beyond:
            wrong.append(f"{path} is refused, and no schema was thought to see it: {seen}")
    for name in sorted(beyond - {path.stem for path in broken}):
        wrong.append(f"there is no {name}")
    for text, where in WRITTEN:
        seen = flaw(validator, "graph: t\n" + text)
        if seen.split(":")[0] != where:
            wrong.append(f"{text}: {seen or 'taken'}; expected: {where or 'taken'}")
    print("\n".join(wrong))
    print(f"{len(shipped)} graphs are taken, {len(broken) - len(beyond)} of {len(broken)} broken ones refused")
    return 1 if wrong or len(shipped) < 5 or len(broken) < 100 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
