"""The migrations of the station database: named steps, each applied once, in one transaction.

Times are integer milliseconds since 1970 (UTC): six bytes instead of the 27 of an ISO text.
"""

from __future__ import annotations

import json
import zlib

from sqlite_utils import Database, Migrations

from station.records import uid7

APPLICATION_ID = 0x35426172  # "5Bar": distinguishes this database from those of other programs

migrations = Migrations("station")


@migrations()
def first_tables(db: Database) -> None:
    """Robots by version, calibrations, readings, results, events, idempotency keys."""
    # Each version of a robot file is stored once; a calibration refers to the version it was made with.
    db.execute(
        """CREATE TABLE robots (
            id INTEGER PRIMARY KEY, serial TEXT NOT NULL, file TEXT NOT NULL, saved_ms INTEGER NOT NULL)"""
    )
    db.execute("CREATE INDEX robots_serial ON robots (serial)")
    db.execute(
        """CREATE TABLE calibrations (
            id INTEGER PRIMARY KEY, robot_id INTEGER NOT NULL REFERENCES robots (id),
            robot_serial TEXT NOT NULL, plan TEXT NOT NULL, operator TEXT NOT NULL,
            work_order TEXT, metadata TEXT, state TEXT NOT NULL, verdict TEXT, reason TEXT,
            step INTEGER NOT NULL DEFAULT 0, steps INTEGER NOT NULL DEFAULT 0,
            created_ms INTEGER NOT NULL, started_ms INTEGER, ended_ms INTEGER)"""
    )
    for column in ("robot_serial", "state", "verdict", "created_ms"):
        db.execute(f"CREATE INDEX calibrations_{column} ON calibrations ({column})")
    # `samples`: a JSON list, each sample's distance from scale_mm rounded to 10 nm, in units of 10 nm.
    db.execute(
        """CREATE TABLE readings (
            calibration_id INTEGER NOT NULL REFERENCES calibrations (id), reading INTEGER NOT NULL,
            walk INTEGER NOT NULL, t_s REAL NOT NULL, theta1_deg REAL NOT NULL, theta2_deg REAL NOT NULL,
            approach1 INTEGER NOT NULL, approach2 INTEGER NOT NULL, scale_mm REAL NOT NULL,
            position TEXT NOT NULL, samples TEXT, temperature_c REAL, payload_kg REAL, mount TEXT,
            PRIMARY KEY (calibration_id, reading)) WITHOUT ROWID"""
    )
    # Values that are queried across runs have separate columns; the others are read one run at a time.
    db.execute(
        """CREATE TABLE results (
            calibration_id INTEGER PRIMARY KEY REFERENCES calibrations (id),
            zero1_deg REAL, zero1_sd_deg REAL, zero2_deg REAL, zero2_sd_deg REAL, rest BLOB NOT NULL)"""
    )
    db.execute(
        """CREATE TABLE events (
            id INTEGER PRIMARY KEY, calibration_id INTEGER REFERENCES calibrations (id),
            at_ms INTEGER NOT NULL, kind TEXT NOT NULL, data TEXT)"""
    )
    db.execute("CREATE INDEX events_calibration ON events (calibration_id)")
    db.execute(
        """CREATE TABLE idempotency_keys (
            key TEXT PRIMARY KEY, body_hash BLOB NOT NULL,
            calibration_id INTEGER NOT NULL REFERENCES calibrations (id)) WITHOUT ROWID"""
    )
    db.execute(f"PRAGMA application_id = {APPLICATION_ID}")


@migrations()
def memories(db: Database) -> None:
    """Data that a passed run leaves to the robot's next one; the newest that was not cleared counts."""
    db.execute(
        """CREATE TABLE memories (
            calibration_id INTEGER PRIMARY KEY REFERENCES calibrations (id), robot_serial TEXT NOT NULL,
            at_ms INTEGER NOT NULL, memory TEXT NOT NULL, cleared_ms INTEGER, cleared_by TEXT)"""
    )
    db.execute("CREATE INDEX memories_robot ON memories (robot_serial, calibration_id)")


@migrations()
def zero_writes(db: Database) -> None:
    """Runs that write the zero offsets of an earlier run to the drives, and every zero they wrote."""
    db.execute("ALTER TABLE calibrations ADD COLUMN of_id INTEGER REFERENCES calibrations (id)")
    db.execute("CREATE INDEX calibrations_of ON calibrations (of_id) WHERE of_id IS NOT NULL")
    # A row is on the disk before its zero is written; `to_deg` and `taken` follow when it was read back.
    db.execute(
        """CREATE TABLE zero_writes (
            id INTEGER PRIMARY KEY, run_id INTEGER NOT NULL REFERENCES calibrations (id),
            joint INTEGER NOT NULL, at_ms INTEGER NOT NULL, offset_deg REAL NOT NULL,
            from_deg REAL NOT NULL, to_deg REAL, taken INTEGER)"""
    )
    db.execute("CREATE INDEX zero_writes_run ON zero_writes (run_id)")


@migrations()
def diagnoses(db: Database) -> None:
    """The whole diagnosis document of a run that has one, compressed; read by itself."""
    db.execute("ALTER TABLE results ADD COLUMN diagnosis BLOB")


# Results of version 0.1.0 were compressed with these words as a dictionary. Only the migration needs them.
_WORDS = (
    b'measure the mechanism\'s mounting error, or use the plan `full`","separating_experiment":"alias_set":'
    b'both arms together with a sideways error of the mechanism","share":"p_value":"effect":"joint":"source":'
    b'"findings":[{"effect":"predicted_position_error_mm":{"rms":,"max":}}"before":{"reading_rms_mm":,"after":'
    b'{"reading_rms_mm":"method":"published","parameters":[{"name":"rMx","value":,"sd":,"unit":"mm"},{"name":'
    b'"rMy","unit":"deg"}],"weak_direction":{"singular_ratio":0.00,"text":","sd_deg":,"remedy":"remedies":'
    b'"iterations":[{"pass":1,"dtheta1_deg":,"dtheta2_deg":-,"total1_deg":,"total2_deg":-,"mu_deg":null,'
    b'"condition":47"residuals":[{"reading":1,"position":"P1","residual_mm":0.000,"limit_mm":0.00},{"reading":'
)


@migrations()
def readable_results(db: Database) -> None:
    """Results as JSON text that SQL can query, documents as plain zlib; kind, outcome, reason as columns."""
    db.execute("ALTER TABLE results ADD COLUMN result TEXT")
    rows = db.execute(
        "SELECT calibration_id, zero1_deg, zero1_sd_deg, zero2_deg, zero2_sd_deg, rest, diagnosis"
        " FROM results"
    )
    for calibration_id, value1, sd1, value2, sd2, rest, diagnosis in rows.fetchall():
        offsets = [
            {"joint": joint, "value_deg": value, "sd_deg": sd}
            for joint, value, sd in ((1, value1, sd1), (2, value2, sd2))
            if value is not None
        ]
        result = {"zero_offsets": offsets, **json.loads(_expand(rest))}
        document = None if diagnosis is None else zlib.compress(_expand(diagnosis), 9)
        db.execute(
            "UPDATE results SET result = ?, diagnosis = ? WHERE calibration_id = ?",
            [json.dumps(result, separators=(",", ":"), ensure_ascii=False), document, calibration_id],
        )
    db.execute("ALTER TABLE results DROP COLUMN rest")
    for column in ("kind", "outcome", "reason_code", "reason_params"):
        db.execute(f"ALTER TABLE calibrations ADD COLUMN {column} TEXT")
    db.execute(
        """UPDATE calibrations SET kind = CASE plan
            WHEN 'diagnostic' THEN 'diagnose' WHEN 'separating' THEN 'separate' WHEN 'apply' THEN 'apply'
            WHEN 'rollback' THEN 'rollback' WHEN 'dataset' THEN 'import' ELSE 'calibrate' END"""
    )
    # a diagnosis that found a cause was a pass; its outcome asks for a repair
    db.execute(
        """UPDATE calibrations SET outcome = CASE
            WHEN state IN ('failed', 'aborted', 'interrupted') THEN state
            WHEN verdict = 'pass' AND kind IN ('diagnose', 'separate', 'import')
                AND (SELECT json_array_length(result, '$.findings') FROM results
                    WHERE calibration_id = id) > 0 THEN 'repair'
            WHEN verdict = 'pass' THEN 'good'
            WHEN verdict = 'fail' AND kind IN ('apply', 'rollback') THEN 'not_verified'
            WHEN verdict = 'fail' THEN 'unexplained' END
        WHERE state NOT IN ('queued', 'running')"""
    )


@migrations()
def uids(db: Database) -> None:
    """A globally unique identity for every run."""
    db.execute("ALTER TABLE calibrations ADD COLUMN uid TEXT")
    rows = db.execute("SELECT id, created_ms FROM calibrations").fetchall()
    for run, created_ms in rows:
        db.execute("UPDATE calibrations SET uid = ? WHERE id = ?", [uid7(created_ms), run])
    db.execute("CREATE UNIQUE INDEX calibrations_uid ON calibrations (uid)")


@migrations()
def chain(db: Database) -> None:
    """The hash of each run that ends from now on, in the order of their ends."""
    db.execute(
        """CREATE TABLE chain (
            n INTEGER PRIMARY KEY, run_id INTEGER NOT NULL UNIQUE, uid TEXT NOT NULL,
            samples_sha256 TEXT NOT NULL, hash TEXT NOT NULL)"""
    )


@migrations()
def filters(db: Database) -> None:
    """Indexes for the filters of a MES."""
    db.execute(
        "CREATE INDEX calibrations_work_order ON calibrations (work_order) WHERE work_order IS NOT NULL"
    )
    db.execute("CREATE INDEX calibrations_ended_ms ON calibrations (ended_ms)")


@migrations()
def wire_logs(db: Database) -> None:
    """The wire traffic of a run, in pieces of one zlib stream; the chain contains its hash."""
    db.execute(
        """CREATE TABLE wire_logs (
            run_id INTEGER NOT NULL REFERENCES calibrations (id), n INTEGER NOT NULL, piece BLOB NOT NULL,
            PRIMARY KEY (run_id, n)) WITHOUT ROWID"""
    )
    db.execute("ALTER TABLE chain ADD COLUMN wire_sha256 TEXT")


@migrations()
def people(db: Database) -> None:
    """Users, keys, sessions; only hashes of their secrets."""
    db.execute(
        """CREATE TABLE users (
            id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE COLLATE NOCASE, role TEXT NOT NULL,
            password_hash TEXT, badge_sha256 BLOB UNIQUE, pin_hash TEXT, created_ms INTEGER NOT NULL)"""
    )
    db.execute(
        """CREATE TABLE api_keys (
            id INTEGER PRIMARY KEY, name TEXT NOT NULL, role TEXT NOT NULL, sha256 BLOB NOT NULL UNIQUE,
            created_ms INTEGER NOT NULL, expires_ms INTEGER, revoked_ms INTEGER, used_ms INTEGER)"""
    )
    db.execute(
        """CREATE TABLE sessions (
            sha256 BLOB PRIMARY KEY, user_id INTEGER NOT NULL REFERENCES users (id) ON DELETE CASCADE,
            seen_ms INTEGER NOT NULL) WITHOUT ROWID"""
    )
    db.execute(
        """CREATE TABLE run_starters (
            run_id INTEGER PRIMARY KEY REFERENCES calibrations (id), name TEXT NOT NULL, via TEXT NOT NULL)"""
    )


@migrations()
def audit(db: Database) -> None:
    """Actions with their authors; the database itself refuses to change or remove an entry."""
    # `hash` covers `who_sha256`, the hash of a salt and the name, so that a name can be erased.
    db.execute(
        """CREATE TABLE audit (
            n INTEGER PRIMARY KEY, at_ms INTEGER NOT NULL, who TEXT, salt TEXT, who_sha256 TEXT NOT NULL,
            via TEXT NOT NULL, role TEXT, action TEXT NOT NULL, subject TEXT NOT NULL, before TEXT,
            after TEXT, hash TEXT NOT NULL)"""
    )
    kept = "at_ms, who_sha256, via, role, action, subject, before, after, hash"
    for deed in ("DELETE", f"UPDATE OF n, {kept}"):
        db.execute(
            f"CREATE TRIGGER audit_{deed.split()[0].lower()} BEFORE {deed} ON audit"
            " BEGIN SELECT raise(ABORT, 'the audit is append-only'); END"
        )


@migrations()
def outbox(db: Database) -> None:
    """Events for other systems, and their delivery."""
    db.execute(
        """CREATE TABLE happenings (
            n INTEGER PRIMARY KEY AUTOINCREMENT, uid TEXT NOT NULL, type TEXT NOT NULL,
            at_ms INTEGER NOT NULL, data TEXT NOT NULL)"""
    )
    db.execute(
        """CREATE TABLE deliveries (
            id INTEGER PRIMARY KEY, receiver TEXT NOT NULL, n INTEGER NOT NULL REFERENCES happenings (n),
            state TEXT NOT NULL, tries INTEGER NOT NULL DEFAULT 0, detail TEXT NOT NULL DEFAULT '',
            next_ms INTEGER NOT NULL, ended_ms INTEGER, UNIQUE (receiver, n))"""
    )
    db.execute("CREATE INDEX deliveries_waiting ON deliveries (receiver, n) WHERE state = 'waiting'")
    db.execute("CREATE TABLE receivers (name TEXT PRIMARY KEY, seen INTEGER NOT NULL) WITHOUT ROWID")


@migrations()
def made_by(db: Database) -> None:
    """Software, devices and scale certificate of a run."""
    db.execute(
        """CREATE TABLE made_by (
            run_id INTEGER PRIMARY KEY REFERENCES calibrations (id), what TEXT NOT NULL)"""
    )


@migrations()
def disabled_users(db: Database) -> None:
    """A user may be disabled without being removed."""
    db.execute("ALTER TABLE users ADD COLUMN disabled_ms INTEGER")


@migrations()
def settings_in_use(db: Database) -> None:
    """The settings of the last start from the station file, to be compared at the next one."""
    db.execute("CREATE TABLE settings_in_use (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID")


@migrations()
def search(db: Database) -> None:
    """Serials are found by their beginning, case-insensitive."""
    db.execute("CREATE INDEX calibrations_serial_nocase ON calibrations (robot_serial COLLATE NOCASE)")


@migrations()
def users_of_a_provider(db: Database) -> None:
    """Users may be identified by a hash of their identity at an OpenID Connect provider."""
    db.execute("ALTER TABLE users ADD COLUMN openid_sha256 BLOB")
    db.execute("CREATE UNIQUE INDEX users_openid ON users (openid_sha256)")


@migrations()
def logs(db: Database) -> None:
    """Logs of other machines to the byte, and their results."""
    db.execute(
        """CREATE TABLE logs (
            run_id INTEGER NOT NULL REFERENCES calibrations (id), part TEXT NOT NULL, name TEXT NOT NULL,
            columns TEXT NOT NULL, measured TEXT NOT NULL, content BLOB NOT NULL,
            PRIMARY KEY (run_id, part)) WITHOUT ROWID"""
    )
    db.execute(
        """CREATE TABLE log_documents (
            run_id INTEGER PRIMARY KEY REFERENCES calibrations (id), residuals BLOB NOT NULL,
            report BLOB NOT NULL)"""
    )


@migrations()
def process_control(db: Database) -> None:
    """Values of thousands of runs for process control have separate columns, and robots have types."""
    db.execute("ALTER TABLE calibrations ADD COLUMN robot_type TEXT")
    db.execute(
        "CREATE INDEX calibrations_robot_type ON calibrations (robot_type) WHERE robot_type IS NOT NULL"
    )
    db.execute("ALTER TABLE results ADD COLUMN position_error_mm REAL")
    db.execute(
        """UPDATE results SET position_error_mm =
            CASE WHEN json_extract(result, '$.after.fresh_reading_rms_mm') IS NOT NULL THEN coalesce(
                json_extract(result, '$.accuracy.bound_95_mm'),
                json_extract(result, '$.after.predicted_position_error_mm.bound_95'),
                json_extract(result, '$.after.predicted_position_error_mm.max')) END"""
    )


# The migration below makes the rows of the runs before it, `keep_result` those of each run since. A later
# migration that changes the table leaves this text unchanged and gives `keep_result` one of its own.
INSERT_FINDINGS = """INSERT INTO findings SELECT calibration_id, finding.key, parameter.key,
    finding.value ->> '$.effect', finding.value ->> '$.joint', finding.value ->> '$.part',
    finding.value ->> '$.probability', finding.value ->> '$.p_value', parameter.value ->> '$.name',
    parameter.value ->> '$.value', parameter.value ->> '$.sd', parameter.value ->> '$.unit'
    FROM results, json_each(result, '$.findings') finding,
        json_each(finding.value, '$.parameters') parameter"""


@migrations()
def findings(db: Database) -> None:
    """Findings are queried across runs: one row for each parameter of an effect."""
    db.execute(
        """CREATE TABLE findings (
            calibration_id INTEGER NOT NULL REFERENCES calibrations (id), finding INTEGER NOT NULL,
            n INTEGER NOT NULL, effect TEXT, joint INTEGER, part TEXT, probability REAL, p_value REAL,
            parameter TEXT, value REAL, sd REAL, unit TEXT,
            PRIMARY KEY (calibration_id, finding, n)) WITHOUT ROWID"""
    )
    db.execute(f"{INSERT_FINDINGS} ORDER BY calibration_id")


@migrations()
def counts(db: Database) -> None:
    """Runs are found by their plan, and counted by serial and outcome."""
    db.execute("CREATE INDEX calibrations_plan ON calibrations (plan)")
    db.execute(
        "CREATE INDEX calibrations_found ON calibrations (robot_serial COLLATE NOCASE, state, verdict, plan)"
    )


def _expand(blob: bytes) -> bytes:
    return zlib.decompressobj(zdict=_WORDS).decompress(blob)
