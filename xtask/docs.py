#!/usr/bin/env python3
"""What `cargo doc` warns of, in seconds: rustdoc's lints over all libraries and programs, and over private items, too.

`cargo doc` would first check all dependencies once more. This script asks Cargo for the libraries of the tests' build and
hands them to rustdoc, which checks and writes no pages. `make lint` calls it with the environment of that build.
"""
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor


def cargo(*arguments):
    command = [os.environ.get("CARGO", "cargo"), *arguments]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def check(package, target, dependencies):
    """Checks one library or program; returns what rustdoc says of it, empty if all is well."""
    command = ["rustdoc", "-Zunstable-options", "--check", "--document-private-items", "-Dwarnings"]
    command += ["--edition", package["edition"], "--crate-name", target["name"].replace("-", "_")]
    command += ["-Ldependency=" + folder, target["src_path"]]
    # Cargo documents a program's private items, for it has no others.
    is_library = "lib" in target["kind"]
    command += ["--crate-type=lib"] if is_library else ["--crate-type=bin", "-Arustdoc::private_intra_doc_links"]
    for name, package_id in dependencies:
        for library in libraries.get(package_id, []):
            command.append(f"--extern={name}={library}")
    # `--check` is not stable yet: a result that no build depends on.
    environment = dict(os.environ, RUSTC_BOOTSTRAP="1", CARGO_PKG_VERSION=package["version"])
    environment["CARGO_MANIFEST_DIR"] = os.path.dirname(package["manifest_path"])
    environment["OUT_DIR"] = scripts.get(package["id"], "")
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout if done.returncode else ""


# Packages of other platforms are not there.
compiler = subprocess.run(["rustc", "-vV"], check=True, stdout=subprocess.PIPE, text=True).stdout
host = next(line.split()[1] for line in compiler.splitlines() if line.startswith("host: "))
metadata = json.loads(cargo("metadata", "--locked", "--filter-platform", host, "--format-version=1"))
folder = os.path.join(metadata["target_directory"], "debug", "deps")
libraries, scripts, features = {}, {}, {}
for line in cargo("test", "--workspace", "--locked", "--no-run", "--message-format=json", "--quiet").splitlines():
    message = json.loads(line)
    if message["reason"] == "build-script-executed":
        scripts[message["package_id"]] = message["out_dir"]
    if message["reason"] == "compiler-artifact" and not message["profile"]["test"]:
        built = [file for file in message["filenames"] if file.endswith((".rlib", ".so", ".dylib"))]
        # A build script may have a package with fewer features, in a library of its own.
        if built and len(message["features"]) >= features.get(message["package_id"], 0):
            features[message["package_id"]] = len(message["features"])
            libraries[message["package_id"]] = built

packages = {package["id"]: package for package in metadata["packages"]}
nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
work = []
for member in metadata["workspace_members"]:
    dependencies = [(dependency["name"], dependency["pkg"]) for dependency in nodes[member]["deps"]]
    for target in packages[member]["targets"]:
        if {"lib", "bin"} & set(target["kind"]):
            work.append((packages[member], target, dependencies))
with ThreadPoolExecutor(os.cpu_count()) as pool:
    faults = [said for said in pool.map(lambda each: check(*each), work) if said]
print("".join(faults), end="", file=sys.stderr)
print(f"doc comments of {len(work)} libraries and programs: {len(faults) or 'none'} at fault")
sys.exit(1 if faults else 0)
