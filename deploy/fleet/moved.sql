-- Which robots moved by more than 0.1 degrees within a quarter, by station.
with runs as (
    select distinct on (event_uid) station, robot_serial, date_trunc('quarter', "at") as quarter, zero1_deg, zero2_deg
    from '/collected/*/*.parquet'
    where type = 'run.ended' and outcome = 'good' and kind = 'calibrate'
)
select
    station,
    robot_serial,
    quarter,
    greatest(max(zero1_deg) - min(zero1_deg), max(zero2_deg) - min(zero2_deg)) as moved_deg,
    count(*) as runs
from runs
group by station, robot_serial, quarter
having moved_deg > 0.1
order by station, moved_deg desc
